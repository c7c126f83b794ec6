// Joints one after the other along x, that turn about z.
#pragma once

#include <fmt/format.h>

#include <string>

namespace hbr {

// Without a limit it is fixed.
inline std::string at(double x, const std::string& name, const std::string& parent, const std::string& child,
                      const std::string& more) {
  return fmt::format(
      R"(<joint name="{}" type="{}"><parent link="{}"/><child link="{}"/><origin xyz="{} 0 0"/>)"
      R"(<axis xyz="0 0 1"/>{}</joint>)",
      name, more.empty() ? "fixed" : "revolute", parent, child, x, more);
}
inline std::string limit(double lower, double upper, double velocity = 1) {
  return fmt::format(R"(<limit lower="{}" upper="{}" effort="1" velocity="{}"/>)", lower, upper, velocity);
}

}  // namespace hbr
