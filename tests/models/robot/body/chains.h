// Chains of links that turn about one axis: what they reach has closed forms.
#pragma once

#include <memory>

#include "models/robot/body/body.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {

struct Turn {
  double lower = -3.2, upper = 3.2;  // rad
};

// Links of 1 m along y where `axis` is x (they stay in the plane x = 0), else along x; joints "j0", "j1", ...
// from the link "base" on, the link "tip" at the end, `aside` the links' plane. `looks` stands inside each of
// the moving links.
inline std::shared_ptr<const Body> chain(const std::vector<Turn>& turns, const std::string& axis = "0 0 1",
                                         const std::string& looks = "", double aside = 0) {
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
  const std::string tip = axis.starts_with("1") ? fmt::format("{} 1 0", aside) : fmt::format("1 0 {}", aside);
  links += link("tip", "");
  joints += fmt::format(
      R"(<joint name="t" type="fixed"><parent link="{}"/><child link="tip"/><origin xyz="{}"/></joint>)",
      parent, tip);
  return std::make_shared<const Body>(load_urdf(folder.write("chain.urdf", robot(links + joints))), names);
}

// Next to nothing to run into.
const std::string kThin =
    R"(<visual><origin xyz="0.1 0.2 0.3"/><geometry><sphere radius="0.0001"/></geometry></visual>)";

// 0.1 m thick, from end to end of a link along x.
const std::string kBox =
    R"(<visual><origin xyz="0.5 0 0"/><geometry><box size="1 0.1 0.1"/></geometry></visual>)";

// The tip reaches every point within 2 m of the origin.
inline std::shared_ptr<const Body> two_links() { return chain({Turn{}, Turn{}}, "0 0 1", kThin); }

}  // namespace hbr
