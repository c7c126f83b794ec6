#include "models/robot/description/urdf_text.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string_view>

namespace hbr::inline robots {
namespace {

// "XML_ERROR_MISMATCHED_ELEMENT": "mismatched element".
std::string words(std::string name) {
  for (const std::string_view prefix : {"XML_", "ERROR_"})
    if (name.starts_with(prefix)) name.erase(0, prefix.size());
  for (char& c : name) c = c == '_' ? ' ' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

}  // namespace

std::vector<double> numbers_in(std::string_view text) {
  constexpr std::string_view kSpace = " \t\r\n";
  std::vector<double> numbers;
  for (;;) {
    const std::size_t begin = text.find_first_not_of(kSpace);
    if (begin == std::string_view::npos) return numbers;
    text.remove_prefix(begin);
    std::string_view word = text.substr(0, text.find_first_of(kSpace));
    text.remove_prefix(word.size());
    if (word.starts_with('+')) word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.begin(), word.end(), numbers.emplace_back());
    if (error != std::errc() || end != word.end() || !std::isfinite(numbers.back())) return {};
  }
}

UrdfText::UrdfText(std::string path, const std::string& text) : path_(std::move(path)) {
  document_.Parse(text.c_str());
  // More than some hundreds deep is refused here: who walks through them recurses.
  if (document_.ErrorID() == tinyxml2::XML_ELEMENT_DEPTH_EXCEEDED)
    throw InputError("{}:{}: elements are nested without end; expected a URDF", path_,
                     document_.ErrorLineNum());
  if (document_.Error()) {
    const bool open = document_.ErrorID() == tinyxml2::XML_ERROR_PARSING ||
                      document_.ErrorID() == tinyxml2::XML_ERROR_MISMATCHED_ELEMENT;
    throw InputError("{}:{}: not XML ({}{}); expected a URDF", path_, std::max(1, document_.ErrorLineNum()),
                     words(document_.ErrorName()), open ? ": is an element not closed?" : "");
  }
  robot_ = document_.FirstChildElement("robot");
  if (robot_) return;
  const XMLElement* top = document_.RootElement();
  throw InputError("{}:{}: no <robot>; expected a URDF, found <{}>", path_, top ? top->GetLineNum() : 1,
                   top ? top->Name() : "nothing");
}

std::string UrdfText::place(const XMLElement& element) const {
  return fmt::format("{}:{}", path_, element.GetLineNum());
}

std::string UrdfText::what(const XMLElement& element) {
  for (const XMLElement* e = &element; e; e = e->Parent() ? e->Parent()->ToElement() : nullptr) {
    const std::string_view kind = e->Name();
    if (kind != "link" && kind != "joint") continue;
    const char* name = e->Attribute("name");
    const std::string owner = fmt::format("{} '{}'", kind, name ? name : "");
    return e == &element ? owner : fmt::format("<{}> of {}", element.Name(), owner);
  }
  return fmt::format("<{}>", element.Name());
}

std::string UrdfText::name(const XMLElement& element, const char* attribute) const {
  const char* value = element.Attribute(attribute);
  if (!value || !*value)
    throw InputError("{}: a <{}> has no '{}'; expected {}=\"a name\"", place(element), element.Name(),
                     attribute, attribute);
  std::string shown = value;
  std::ranges::replace_if(
      shown, [](unsigned char c) { return std::iscntrl(c); }, ' ');
  if (shown != value)
    throw InputError("{}: a <{}> has a control character in its {} '{}'; expected a name in one line",
                     place(element), element.Name(), attribute, shown);
  return value;
}

double UrdfText::number(const XMLElement* element, const char* attribute, double otherwise,
                        double most) const {
  const char* text = element ? element->Attribute(attribute) : nullptr;
  if (!text) return otherwise;
  const std::vector<double> found = numbers_in(text);
  if (found.size() == 1 && std::abs(found[0]) <= most) return found[0];
  refuse(*element, "has {} '{}'; expected a number within {:g}, such as -0.5 or 2e-3", attribute, text, most);
}

Eigen::Vector3d UrdfText::three(const XMLElement* element, const char* attribute,
                                const Eigen::Vector3d& otherwise, double most) const {
  const char* text = element ? element->Attribute(attribute) : nullptr;
  if (!text) return otherwise;
  const std::vector<double> found = numbers_in(text);
  if (found.size() == 3 && std::ranges::all_of(found, [&](double x) { return std::abs(x) <= most; }))
    return Eigen::Vector3d(found.data());
  refuse(*element, "has {} '{}'; expected 3 numbers within {:g}, such as 0 -0.5 2e-3", attribute, text, most);
}

void UrdfText::add_oddity(const XMLElement& element, const std::string& text) {
  const std::string kind = fmt::format("{} {}", element.Name(), text);
  const auto known = std::ranges::find(oddities_, kind, &Oddity::kind);
  if (known != oddities_.end())
    ++known->more;
  else
    oddities_.push_back({kind, fmt::format("{}: {} {}", place(element), what(element), text), 0});
}

std::vector<std::string> UrdfText::oddities() const {
  std::vector<std::string> lines;
  for (const Oddity& oddity : oddities_)
    lines.push_back(oddity.more ? fmt::format("{} (and {} more)", oddity.line, oddity.more) : oddity.line);
  return lines;
}

// Roll, pitch and yaw are turns about the axes x, y and z that stay where they are, one after the other.
Eigen::Isometry3d UrdfText::origin(const XMLElement& element) const {
  const XMLElement* e = element.FirstChildElement("origin");
  const Eigen::Vector3d half = three(e, "rpy", {0, 0, 0}) / 2;
  const Eigen::Vector3d s = half.array().sin(), c = half.array().cos();
  Eigen::Quaterniond turn(c[0] * c[1] * c[2] + s[0] * s[1] * s[2], s[0] * c[1] * c[2] - c[0] * s[1] * s[2],
                          c[0] * s[1] * c[2] + s[0] * c[1] * s[2], c[0] * c[1] * s[2] - s[0] * s[1] * c[2]);
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  result.translate(three(e, "xyz", {0, 0, 0}));
  result.rotate(turn.normalized());
  return result;
}

}  // namespace hbr::inline robots
