#include "reports/plot/colour.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

#include "pipeline/core/check.h"

namespace hbr::inline reports {
namespace {

struct Entry {
  const char* variable;
  std::uint32_t name;   // what drawings say
  std::uint32_t paper;  // what a file of its own shows
};

// In the order of the enumeration; behind them what words have in place of some.
constexpr std::array<Entry, 15> kColours = {{{"ink", 0x010203, 0x22262b},
                                             {"faint", 0x040506, 0xd9dce1},
                                             {"blue", 0x0072b2, 0x0072b2},
                                             {"orange", 0xe69f00, 0xe69f00},
                                             {"green", 0x009e73, 0x009e73},
                                             {"vermilion", 0xd55e00, 0xd55e00},
                                             {"purple", 0xcc79a7, 0xcc79a7},
                                             {"sky", 0x56b4e9, 0x56b4e9},
                                             {"grey", 0x7a8088, 0x7a8088},
                                             {"orange-words", 0x9c6700, 0x9c6700},
                                             {"green-words", 0x007a59, 0x007a59},
                                             {"vermilion-words", 0xc04f00, 0xc04f00},
                                             {"purple-words", 0xa3457e, 0xa3457e},
                                             {"sky-words", 0x2279b0, 0x2279b0},
                                             {"grey-words", 0x666d75, 0x666d75}}};

std::string hex(std::uint32_t value) { return fmt::format("#{:06x}", value); }

const Entry* find(std::uint32_t name) {
  for (const Entry& entry : kColours)
    if (entry.name == name) return &entry;
  return nullptr;
}

// "#rrggbb" or gnuplot's "rgb(  0, 114, 178)" at the head of `text`: its value and length.
std::optional<std::pair<std::uint32_t, std::size_t>> read_colour(std::string_view text) {
  std::uint32_t value = 0;
  if (text.starts_with('#')) {
    if (text.size() < 7) return {};
    const auto end = std::from_chars(text.data() + 1, text.data() + 7, value, 16);
    if (end.ptr != text.data() + 7) return {};
    return {{value, 7}};
  }
  std::size_t at = 4;  // behind "rgb("
  for (int channel = 0; channel < 3; ++channel) {
    while (at < text.size() && text[at] == ' ') ++at;
    std::uint32_t level = 0;
    const auto end = std::from_chars(text.data() + at, text.data() + text.size(), level);
    if (end.ec != std::errc{} || level > 255) return {};
    value = value << 8 | level;
    at = static_cast<std::size_t>(end.ptr - text.data());
    if (at >= text.size() || text[at] != (channel < 2 ? ',' : ')')) return {};
    ++at;
  }
  return {{value, at}};
}

template <class Replacement>
std::string recolour(std::string_view svg, Replacement replacement) {
  std::string result;
  result.reserve(svg.size());
  for (std::size_t i = 0; i < svg.size();) {
    const std::string_view rest = svg.substr(i);
    if (rest[0] == '#' || rest.starts_with("rgb("))
      if (const auto colour = read_colour(rest))
        if (const Entry* entry = find(colour->first)) {
          result += replacement(*entry);
          i += colour->second;
          continue;
        }
    result += svg[i++];
  }
  return result;
}

}  // namespace

std::string hex(Colour colour) { return hex(kColours.at(static_cast<std::size_t>(colour)).name); }

std::string hex_of_words(Colour colour) {
  const std::string words = std::string(kColours.at(static_cast<std::size_t>(colour)).variable) + "-words";
  const auto darker =
      std::ranges::find(kColours, words, [](const Entry& entry) { return std::string(entry.variable); });
  return darker == kColours.end() ? hex(colour) : hex(darker->name);
}

std::string recolour_for_page(std::string_view svg) {
  return recolour(svg, [](const Entry& entry) { return fmt::format("var(--{})", entry.variable); });
}

std::string recolour_for_paper(std::string_view svg) {
  return recolour(svg, [](const Entry& entry) { return hex(entry.paper); });
}

}  // namespace hbr::inline reports
