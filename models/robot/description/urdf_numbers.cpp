#include "models/robot/description/urdf_numbers.h"

#include <tinyxml2.h>

#include <charconv>
#include <cmath>
#include <string_view>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

struct Numbers {
  std::string_view element, attribute;
  int count;
  double most;  // in magnitude: beyond it sums and squares overflow, and nothing is that large
};
constexpr double kLength = 1e6, kWeight = 1e15, kLimit = 1e18;  // some write 1e16 for "no limit"
constexpr Numbers kNumbers[] = {
    {"origin", "xyz", 3, kLength},      {"origin", "rpy", 3, kLength},      {"axis", "xyz", 3, kLength},
    {"box", "size", 3, kLength},        {"mesh", "scale", 3, kLength},      {"color", "rgba", 4, kLength},
    {"cylinder", "radius", 1, kLength}, {"cylinder", "length", 1, kLength}, {"sphere", "radius", 1, kLength},
    {"mass", "value", 1, kWeight},      {"inertia", "ixx", 1, kWeight},     {"inertia", "ixy", 1, kWeight},
    {"inertia", "ixz", 1, kWeight},     {"inertia", "iyy", 1, kWeight},     {"inertia", "iyz", 1, kWeight},
    {"inertia", "izz", 1, kWeight},     {"limit", "lower", 1, kLimit},      {"limit", "upper", 1, kLimit},
    {"limit", "effort", 1, kLimit},     {"limit", "velocity", 1, kLimit},   {"mimic", "offset", 1, kLength},
    {"mimic", "multiplier", 1, kLength}};

// How many numbers of at most this magnitude a text holds; -1 where it holds something else.
int count_numbers(std::string_view text, double most) {
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
    if (error != std::errc() || end != word.end() || !(std::abs(number) <= most)) return -1;
    ++count;
  }
}

void check_below(const std::string& path, const tinyxml2::XMLElement& parent, const std::string& what) {
  for (const tinyxml2::XMLElement* e = parent.FirstChildElement(); e; e = e->NextSiblingElement()) {
    for (const Numbers& n : kNumbers) {
      if (e->Name() != n.element) continue;
      const char* text = e->Attribute(n.attribute.data());
      if (text && count_numbers(text, n.most) != n.count)
        throw InputError("{}:{}: {} of <{}> in {} is '{}'; expected {} within {:g}", path, e->GetLineNum(),
                         n.attribute, n.element, what, text,
                         n.count == 1 ? "a number" : fmt::format("{} numbers", n.count), n.most);
    }
    check_below(path, *e, what);
  }
}

}  // namespace

void check_numbers(const std::string& path, const tinyxml2::XMLElement& robot) {
  for (const char* kind : {"link", "joint"})
    for (const tinyxml2::XMLElement* e = robot.FirstChildElement(kind); e; e = e->NextSiblingElement(kind)) {
      const char* name = e->Attribute("name");
      check_below(path, *e, fmt::format("{} '{}'", kind, name ? name : ""));
    }
}

}  // namespace hbr
