// JSON read strictly: UTF-8, one value and nothing behind it, no key twice, no number too large for a double,
// not nested without end. What its fields must be is described as in settings.h.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace hbr::inline core {

// `where` leads the error: the file, or what else the text stands in. Throws InputError, one line.
nlohmann::json parse_json(std::string_view text, const std::string& where);

}  // namespace hbr::inline core
