// Data for the page's scripts: named arrays and a few words, deflated into one text of the page. It needs no
// network and is read by unpack() of scripts/pack.js.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hbr::inline reports {

// Inflated, a pack is: the length of its header (uint32, little-endian), the header (JSON), and the arrays
// one after the other. The header has `words` and `arrays`, a list of {name, type, shape, delta}. Of each
// array first the lowest byte of every value stands there, then the next byte, and so on; with delta = d > 0
// each value but the first d is less the one d before it, modulo its range (of a float32's bits). The d that
// deflates best of 0, 1 and the size of a row is taken, for each array by itself.
class Pack {
 public:
  // The name is part of an HTML id: letters, digits, '-' and '_'.
  explicit Pack(std::string name);

  // What the arrays do not say: attributes, names, units. A key given twice is replaced.
  void word(const std::string& key, nlohmann::json value);
  // T is one of std::uint8_t, std::uint16_t, std::int32_t, float: "u8", "u16", "i32", "f32" to the scripts.
  // Throws InputError where the name stands twice, or the values are not as many as the shape says.
  template <class T>
  void array(const std::string& name, const std::vector<std::size_t>& shape, const std::vector<T>& values);

  // <script type="text/plain" id="pack-NAME">, base64 of what is deflated. The same content, the same bytes.
  std::string html() const;

 private:
  std::string name_;
  nlohmann::json words_ = nlohmann::json::object(), arrays_ = nlohmann::json::array();
  std::string bytes_;
};

}  // namespace hbr::inline reports
