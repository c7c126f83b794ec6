// Text and bytes into HTML.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hbr::inline reports {

// & < > " ' as entities: safe in text and in quoted attributes.
std::string escape_html(std::string_view text);

// The relative address of a file: what is no letter, no digit and none of - . _ ~ / as %XX.
std::string escape_url(std::string_view path);

// As RFC 4648 has it, with padding.
std::string base64(std::string_view bytes);

// "data:image/png;base64,..." of the bytes.
std::string data_uri(std::string_view bytes, std::string_view media_type);

// A table that scrolls within its box where it is wide; `caption`, the cells of `head` and of `rows` are
// HTML. The first cell of a row names it. `css` is the table's class, or "".
std::string html_table(const std::string& caption, const std::vector<std::string>& head,
                       const std::vector<std::vector<std::string>>& rows, const std::string& css = "");

}  // namespace hbr::inline reports
