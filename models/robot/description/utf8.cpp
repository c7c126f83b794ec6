#include "models/robot/description/utf8.h"

#include <iconv.h>

#include <algorithm>
#include <cerrno>
#include <optional>
#include <regex>
#include <string_view>

#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

using namespace std::string_view_literals;

struct Converted {
  std::string text;
  std::size_t read;  // bytes until the first that do not belong there
};

// Nothing where iconv does not know the encoding.
std::optional<Converted> converted(std::string_view bytes, const std::string& encoding) {
  const iconv_t converter = iconv_open("UTF-8", encoding.c_str());
  if (converter == reinterpret_cast<iconv_t>(-1)) return {};
  Converted result{};
  char* in = const_cast<char*>(bytes.data());  // iconv does not write there
  std::size_t left = bytes.size();
  for (bool more = left > 0; more;) {
    char buffer[4096];
    char* out = buffer;
    std::size_t room = sizeof buffer;
    more = iconv(converter, &in, &left, &out, &room) == static_cast<std::size_t>(-1) && errno == E2BIG;
    result.text.append(buffer, sizeof buffer - room);
  }
  iconv_close(converter);
  result.read = bytes.size() - left;
  return result;
}

// Of a text whose bytes below 128 are ASCII.
std::string declared_encoding(const std::string& bytes) {
  static const std::regex declaration(R"re(^\s*<\?xml[^>]*\sencoding\s*=\s*["']([^"']+)["'])re");
  const std::string begin = bytes.substr(0, 300);
  std::smatch match;
  return std::regex_search(begin, match, declaration) ? match[1].str() : "UTF-8";
}

std::string wide_encoding(std::string_view bytes) {
  // By the mark, then by how "<" looks; the longer patterns first, for UTF-32's begin like UTF-16's.
  constexpr std::pair<std::string_view, const char*> kPatterns[] = {
      {"\xff\xfe\0\0"sv, "UTF-32LE"}, {"\0\0\xfe\xff"sv, "UTF-32BE"}, {"<\0\0\0"sv, "UTF-32LE"},
      {"\0\0\0<"sv, "UTF-32BE"},      {"\xff\xfe"sv, "UTF-16LE"},     {"\xfe\xff"sv, "UTF-16BE"},
      {"<\0"sv, "UTF-16LE"},          {"\0<"sv, "UTF-16BE"}};
  for (const auto& [pattern, name] : kPatterns)
    if (bytes.starts_with(pattern)) return name;
  return "";
}

}  // namespace

std::string utf8_of_xml(const std::string& path, const std::string& bytes, std::vector<std::string>& odd) {
  constexpr std::string_view kMark = "\xef\xbb\xbf";  // of UTF-8; the others become it
  const auto unmarked = [&](const std::string& text) {
    return text.starts_with(kMark) ? text.substr(kMark.size()) : text;
  };
  if (const std::string wide = wide_encoding(bytes); !wide.empty()) {
    const auto text = converted(bytes, wide);
    if (!text || text->read < bytes.size())
      throw InputError("{}: begins as {}, but is not from byte {} on; expected XML, best in UTF-8", path,
                       wide, text ? text->read : 0);
    return unmarked(text->text);
  }
  if (std::ranges::all_of(bytes, [](unsigned char c) { return c < 128; })) return bytes;

  const std::string encoding = bytes.starts_with(kMark) ? "UTF-8" : declared_encoding(bytes);
  const auto text = converted(bytes, encoding);
  if (text && text->read == bytes.size()) return unmarked(text->text);
  if (!text && converted(bytes, "UTF-8")->read != bytes.size())
    throw InputError("{}:1: the encoding '{}' is unknown here; expected UTF-8 (iconv converts a file to it)",
                     path, encoding);
  if (!text) {
    odd.push_back(fmt::format("{}:1: the encoding '{}' is unknown here: read as UTF-8", path, encoding));
    return bytes;
  }
  const auto line =
      1 + std::count(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(text->read), '\n');
  odd.push_back(
      fmt::format("{}:{}: not {}, which {}: read as ISO-8859-1; name the encoding in the first line", path,
                  line, encoding, encoding == "UTF-8" ? "XML is without a word" : "the first line declares"));
  return converted(unmarked(bytes), "ISO-8859-1")->text;
}

}  // namespace hbr::inline robots
