#include "reports/page/pack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <map>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

// A second reader, written from the description alone: bits, six at a time, and values from their planes.
std::string from_base64(const std::string& text) {
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

std::string inflated(const std::string& packed) {
  std::string bytes(std::size_t{1} << 22, '\0');
  uLongf size = bytes.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                       reinterpret_cast<const Bytef*>(packed.data()), packed.size()),
            Z_OK);
  bytes.resize(size);
  return bytes;
}

class Unpacked {
 public:
  explicit Unpacked(const std::string& html) {
    const std::size_t begin = html.find('>') + 1;
    const std::string all = inflated(from_base64(html.substr(begin, html.find('<', begin) - begin)));
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
        EXPECT_EQ(size, sizeof(T));
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
    ADD_FAILURE() << "no array " << name;
    return {};
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

TEST(Pack, ComesBackAsItWas) {
  Rng rng(Seed(1));
  std::vector<std::uint8_t> image;
  std::vector<std::uint16_t> way;
  std::vector<std::int32_t> id;
  std::vector<float> place{0.0f, -0.0f, 1e-42f, std::numeric_limits<float>::max(), -1.5f, 0.1f};
  for (int i = 0; i < 1000; ++i) {
    image.push_back(static_cast<std::uint8_t>(rng.below(256)));
    way.push_back(static_cast<std::uint16_t>(rng.below(65536)));
    id.push_back(static_cast<std::int32_t>(rng.below(4000000000u)));
    place.push_back(rng.uniform(-1, 1));
  }
  Pack pack("digits-00");
  pack.word("names", {"latent 1", "é <&>"});
  pack.word("replication", 3);
  pack.array("image", {10, 10, 10}, image);
  pack.array("way", {1000}, way);
  pack.array("id", {1000, 1}, id);
  pack.array("place", {503, 2}, place);
  pack.array("none", {0, 28}, std::vector<float>{});
  const std::string html = pack.html();
  EXPECT_TRUE(html.starts_with("<script type=\"text/plain\" id=\"pack-digits-00\">"));
  EXPECT_TRUE(html.ends_with("</script>\n"));
  const Unpacked unpacked(html);
  EXPECT_EQ(unpacked.header.at("words"),
            (nlohmann::json{{"names", {"latent 1", "é <&>"}}, {"replication", 3}}));
  EXPECT_EQ(unpacked.header.at("arrays").at(0).at("shape"), nlohmann::json({10, 10, 10}));
  EXPECT_EQ(unpacked.read<std::uint8_t>("image"), image);
  EXPECT_EQ(unpacked.read<std::uint16_t>("way"), way);
  EXPECT_EQ(unpacked.read<std::int32_t>("id"), id);
  EXPECT_EQ(unpacked.read<float>("none"), std::vector<float>{});
  const std::vector<float> back = unpacked.read<float>("place");
  ASSERT_EQ(back.size(), place.size());
  EXPECT_EQ(std::memcmp(back.data(), place.data(), 4 * place.size()), 0);  // -0 and subnormals, too
  EXPECT_EQ(unpacked.size(), 1000u + 2 * 1000 + 4 * 1000 + 4 * 1006);
}

// What changes little from value to value, or from row to row, is kept as differences; what does not, is not.
TEST(Pack, TakesTheDifferencesThatDeflateBest) {
  std::vector<std::int32_t> steps, rows;
  std::vector<std::uint8_t> zeros(4000, 0);
  Rng rng(Seed(2));
  for (int i = 0; i < 4000; ++i) {
    steps.push_back((i > 0 ? steps.back() : 0) + 1000 + static_cast<int>(rng.below(8)));
    rows.push_back(i < 40 ? static_cast<std::int32_t>(rng.below(4000000000u)) : rows[i - 40] + 70000);
  }
  const auto pack_of = [&] {
    Pack pack("p");
    pack.array("steps", {4000}, steps);
    pack.array("rows", {100, 40}, rows);
    pack.array("zeros", {4000}, zeros);
    return pack.html();
  };
  const std::string html = pack_of();
  EXPECT_EQ(html, pack_of());
  const Unpacked unpacked(html);
  EXPECT_EQ(unpacked.delta("steps"), 1u);
  EXPECT_EQ(unpacked.delta("rows"), 40u);
  EXPECT_EQ(unpacked.delta("zeros"), 0u);
  EXPECT_EQ(unpacked.read<std::int32_t>("steps"), steps);
  EXPECT_EQ(unpacked.read<std::int32_t>("rows"), rows);
  EXPECT_LT(html.size(), 4000u);  // of 36 000 bytes
}

TEST(Pack, RefusesWhatCannotBeRead) {
  EXPECT_THAT([] { Pack pack("a b"); }, ThrowsMessage<InputError>(HasSubstr("pack 'a b'")));
  Pack pack("p");
  pack.array("x", {2}, std::vector<float>{1, 2});
  EXPECT_THAT([&] { pack.array("x", {1}, std::vector<float>{1}); },
              ThrowsMessage<InputError>(HasSubstr("'x' stands twice")));
  EXPECT_THAT(
      [&] {
        pack.array("y", {2, 3}, std::vector<float>{1});
      },
      ThrowsMessage<InputError>(HasSubstr("'y' has 1 values; its shape asks for 6")));
}

}  // namespace
}  // namespace hbr
