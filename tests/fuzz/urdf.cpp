// A robot: its URDF, up to the body that it makes.
#include "models/robot/body/body.h"
#include "models/robot/body/chain.h"
#include "models/robot/body/robot_facts.h"
#include "tests/fuzz/fuzz.h"

namespace hbr::fuzz {

std::vector<std::string> examples() {
  const std::string arm = R"(<?xml version="1.0"?>
<robot name="arm">
<material name="red"><color rgba="1 0 0 1"/></material>
<link name="base"/>
<link name="upper"><inertial><origin xyz="0 0 .1" rpy="0 0 .2"/><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><box size="1 2 3"/></geometry><material name="red"/></visual>
<visual><origin rpy="1 2 3"/><geometry><mesh filename="package://a/b.stl" scale="1 1 1"/></geometry></visual></link>
<link name="tip"><inertial><mass value="1"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial>
<visual><geometry><cylinder radius=".1" length="1"/></geometry></visual>
<visual><geometry><sphere radius=".1"/></geometry></visual></link>
<joint name="pan" type="revolute"><parent link="base"/><child link="upper"/><origin xyz="0 0 1"/><axis xyz="0 0 1"/>
<limit lower="-1" upper="1" effort="5" velocity="2"/></joint>
<joint name="lift" type="prismatic"><parent link="upper"/><child link="tip"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="1" effort="5" velocity="2"/><mimic joint="pan" multiplier="2" offset=".1"/></joint>
</robot>
)";
  const std::string odd = R"(<?xml version="1.0" encoding="ISO-8859-1"?>
<robot><link name="a"><inertial><mass value="-1"/></inertial><visual><geometry><box size="0 1 1"/></geometry>
<material name="m"><color rgba="200 0 0 1"/></material></visual>
<collision><geometry><capsule radius="1" length="1"/></geometry></collision></link>
<link name="b"><visual><geometry><capsule radius="1" length="1"/></geometry></visual></link><link name="c"/><link name="d"/>
<joint name="i" type="floating"><parent link="a"/><child link="b"/></joint>
<joint name="j" type="revolute"><parent link="b"/><child link="c"/><limit lower="1" upper="-1"/><mimic joint="k"/></joint>
<joint name="k" type="continuous"><parent link="c"/><child link="d"/><mimic joint="i" offset="2"/></joint></robot>
)";
  return {arm, odd, content_of_file(HBR_SOURCE_DIR "/models/industrial/six_joint_arm.urdf")};
}

void read(const std::string& bytes) {
  const RobotModel model = load_urdf(written("robot.urdf", bytes));
  and_go_on([&] { joint_table(model); });
  and_go_on([&] {
    for (const Chain& chain : chains_of(model)) {
      farthest_reach(chain);
      reached_points(chain, 3);
    }
  });
  and_go_on([&] { oddities(model, 1); });
  const Body body(model, model.independent_joints());
  body.link_poses(body.posture({}));
}

}  // namespace hbr::fuzz
