// Names that a file gives, fit for a message of one line.
#pragma once

#include <algorithm>
#include <cctype>
#include <string>

namespace hbr::inline onnx {

inline std::string shown(std::string name) {
  constexpr std::size_t kLongest = 200;
  if (name.size() > kLongest) name = name.substr(0, kLongest) + "...";
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::iscntrl(c); }, '?');
  return name;
}

}  // namespace hbr::inline onnx
