#include "models/simbody/urdf_numbers.h"

#include <tinyxml.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

struct Numbers {
  std::string_view element, attribute;
  int count;
};
constexpr Numbers kNumbers[] = {
    {"origin", "xyz", 3},    {"origin", "rpy", 3},      {"axis", "xyz", 3},        {"box", "size", 3},
    {"mesh", "scale", 3},    {"color", "rgba", 4},      {"cylinder", "radius", 1}, {"cylinder", "length", 1},
    {"sphere", "radius", 1}, {"mass", "value", 1},      {"inertia", "ixx", 1},     {"inertia", "ixy", 1},
    {"inertia", "ixz", 1},   {"inertia", "iyy", 1},     {"inertia", "iyz", 1},     {"inertia", "izz", 1},
    {"limit", "lower", 1},   {"limit", "upper", 1},     {"limit", "effort", 1},    {"limit", "velocity", 1},
    {"mimic", "offset", 1},  {"mimic", "multiplier", 1}};

// How many finite numbers a text holds; -1 where it holds something else.
int finite_numbers(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  int count = 0;
  for (;;) {
    const std::size_t begin = text.find_first_not_of(kSpace);
    if (begin == std::string_view::npos) return count;
    text.remove_prefix(begin);
    std::string_view word = text.substr(0, text.find_first_of(kSpace));
    text.remove_prefix(word.size());
    if (word.starts_with('+')) word.remove_prefix(1);
    double number;
    const auto [end, error] = std::from_chars(word.begin(), word.end(), number);
    if (error != std::errc() || end != word.end() || !std::isfinite(number)) return -1;
    ++count;
  }
}

void check_below(const std::string& path, const TiXmlElement& parent, const std::string& what) {
  for (const TiXmlElement* e = parent.FirstChildElement(); e; e = e->NextSiblingElement()) {
    for (const Numbers& n : kNumbers) {
      if (e->ValueStr() != n.element) continue;
      const char* text = e->Attribute(n.attribute.data());
      if (text && finite_numbers(text) != n.count)
        throw InputError("{}:{}: {} of <{}> in {} is '{}'; expected {}", path, e->Row(), n.attribute,
                         n.element, what, text,
                         n.count == 1 ? "a number" : fmt::format("{} numbers", n.count));
    }
    check_below(path, *e, what);
  }
}

}  // namespace

void check_numbers(const std::string& path, const TiXmlElement& robot) {
  for (const char* kind : {"link", "joint"})
    for (const TiXmlElement* e = robot.FirstChildElement(kind); e; e = e->NextSiblingElement(kind)) {
      const char* name = e->Attribute("name");
      check_below(path, *e, fmt::format("{} '{}'", kind, name ? name : ""));
    }
}

}  // namespace hbr
