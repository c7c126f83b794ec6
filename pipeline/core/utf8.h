// Texts from outside, such as paths, that go into files whose texts are UTF-8.
#pragma once

#include <string>

namespace hbr::inline core {

bool is_utf8(const std::string& text);

// With U+FFFD in place of what is not.
std::string as_utf8(const std::string& text);

}  // namespace hbr::inline core
