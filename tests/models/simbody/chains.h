// Chains of links that turn about one axis: what they reach has closed forms.
#pragma once

#include <memory>

#include "models/simbody/body.h"
#include "tests/models/simbody/urdf_text.h"

namespace hbr {

struct Turn {
  double lower = -3.2, upper = 3.2;  // rad
};

// Links of 1 m along y where `axis` is x (they stay in the plane x = 0), else along x; joints "j0", "j1", ...
// from the link "base" on, the link "tip" at the end. `looks` stands inside each of the moving links.
inline std::shared_ptr<const Body> chain(const std::vector<Turn>& turns, const std::string& axis = "0 0 1",
                                         const std::string& looks = "") {
  const TestFolder folder;
  const std::string along = axis.starts_with("1") ? "0 1 0" : "1 0 0";
  std::string links = link("base", ""), joints, parent = "base";
  std::vector<std::string> names;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    const std::string child = fmt::format("link{}", i), name = fmt::format("j{}", i);
    links += link(child, inertial() + looks);
    joints += fmt::format(
        R"(<joint name="{}" type="revolute"><parent link="{}"/><child link="{}"/><origin xyz="{}"/>
           <axis xyz="{}"/><limit lower="{}" upper="{}" effort="1" velocity="1"/></joint>)",
        name, parent, child, i == 0 ? "0 0 0" : along, axis, turns[i].lower, turns[i].upper);
    names.push_back(name);
    parent = child;
  }
  links += link("tip", "");
  joints += fmt::format(
      R"(<joint name="t" type="fixed"><parent link="{}"/><child link="tip"/><origin xyz="{}"/></joint>)",
      parent, along);
  return std::make_shared<const Body>(load_urdf(folder.write("chain.urdf", robot(links + joints))), names);
}

// The tip reaches every point within 2 m of the origin.
inline std::shared_ptr<const Body> two_links(const std::string& axis = "0 0 1") {
  return chain({Turn{}, Turn{}}, axis);
}

}  // namespace hbr
