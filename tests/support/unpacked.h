// A second reader of the page's packs (reports/page/pack.h), written from their description alone: bits, six
// at a time, and values from their planes.
#pragma once

#include <zlib.h>

#include <cstdint>
#include <cstring>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace hbr {

inline std::string from_base64(const std::string& text) {
  const std::string alphabet = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0, held = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(alphabet.find(c));
    if ((held += 6) < 8) continue;
    held -= 8;
    bytes += static_cast<char>(bits >> held & 0xff);
  }
  return bytes;
}

inline std::string inflated(const std::string& packed) {
  std::string bytes(std::size_t{1} << 24, '\0');
  uLongf size = bytes.size();
  if (uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size, reinterpret_cast<const Bytef*>(packed.data()),
                 packed.size()) != Z_OK)
    throw std::runtime_error("the pack is not what zlib deflates");
  bytes.resize(size);
  return bytes;
}

class Unpacked {
 public:
  // The pack of that name in a page.
  Unpacked(const std::string& page, const std::string& name) {
    const std::string opening = "<script type=\"text/plain\" id=\"pack-" + name + "\">";
    const std::size_t at = page.find(opening), begin = at + opening.size();
    if (at == std::string::npos) throw std::runtime_error("the page has no pack " + name);
    const std::string all = inflated(from_base64(page.substr(begin, page.find('<', begin) - begin)));
    std::size_t length = 0;
    for (int byte = 3; byte >= 0; --byte) length = length << 8 | static_cast<unsigned char>(all[byte]);
    header = nlohmann::json::parse(all.substr(4, length));
    bytes_ = all.substr(4 + length);
  }

  template <class T>
  std::vector<T> read(const std::string& name) const {
    std::size_t at = 0;
    for (const auto& array : header.at("arrays")) {
      std::size_t n = 1;
      for (const std::size_t length : array.at("shape")) n *= length;
      const std::map<std::string, std::size_t> sizes{{"u8", 1}, {"u16", 2}, {"i32", 4}, {"f32", 4}};
      const std::size_t size = sizes.at(array.at("type")), delta = array.at("delta");
      if (array.at("name") == name) {
        if (size != sizeof(T)) throw std::runtime_error(name + " has values of another size");
        std::vector<std::uint64_t> bits(n);
        std::vector<T> values(n);
        for (std::size_t i = 0; i < n; ++i) {
          for (std::size_t byte = 0; byte < size; ++byte)
            bits[i] += static_cast<std::uint64_t>(static_cast<unsigned char>(bytes_[at + byte * n + i]))
                       << (8 * byte);
          if (delta > 0 && i >= delta)
            bits[i] = (bits[i] + bits[i - delta]) % (std::uint64_t{1} << (8 * size));
          std::memcpy(&values[i], &bits[i], size);
        }
        return values;
      }
      at += n * size;
    }
    throw std::runtime_error("the pack has no array " + name);
  }
  std::vector<std::size_t> shape(const std::string& name) const {
    for (const auto& array : header.at("arrays"))
      if (array.at("name") == name) return array.at("shape");
    throw std::runtime_error("the pack has no array " + name);
  }
  std::size_t delta(const std::string& name) const {
    for (const auto& array : header.at("arrays"))
      if (array.at("name") == name) return array.at("delta");
    return std::numeric_limits<std::size_t>::max();
  }
  std::size_t size() const { return bytes_.size(); }

  nlohmann::json header;

 private:
  std::string bytes_;
};

}  // namespace hbr
