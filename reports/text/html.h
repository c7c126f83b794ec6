// Text and bytes into HTML.
#pragma once

#include <string>
#include <string_view>

namespace hbr {

// & < > " ' as entities: safe in text and in quoted attributes.
std::string escape_html(std::string_view text);

// "data:image/png;base64,..." of the bytes.
std::string data_uri(std::string_view bytes, std::string_view media_type);

}  // namespace hbr
