// Sound robots are read as urdfdom, the reader of ROS, reads them.
#include <gtest/gtest.h>
#include <urdf_parser/urdf_parser.h>

#include <numbers>

#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

Eigen::Vector3d vector(const urdf::Vector3& v) { return {v.x, v.y, v.z}; }

Eigen::Isometry3d pose(const urdf::Pose& p) {
  Eigen::Isometry3d result(Eigen::Translation3d(vector(p.position)));
  result.rotate(Eigen::Quaterniond(p.rotation.w, p.rotation.x, p.rotation.y, p.rotation.z));
  return result;
}

void expect_same(const Link& ours, const urdf::Link& theirs) {
  ASSERT_EQ(ours.inertial.has_value(), theirs.inertial != nullptr) << ours.name;
  if (ours.inertial) {
    const urdf::Inertial& in = *theirs.inertial;
    Eigen::Matrix3d inertia;
    inertia << in.ixx, in.ixy, in.ixz, in.ixy, in.iyy, in.iyz, in.ixz, in.iyz, in.izz;
    const Eigen::Matrix3d turn = pose(in.origin).linear();
    EXPECT_EQ(ours.inertial->mass, in.mass);
    EXPECT_EQ(ours.inertial->centre, vector(in.origin.position));
    EXPECT_LT((ours.inertial->inertia - turn * inertia * turn.transpose()).norm(), 1e-15 * inertia.norm());
  }
  ASSERT_EQ(ours.visuals.size(), theirs.visual_array.size()) << ours.name;
  for (std::size_t i = 0; i < ours.visuals.size(); ++i) {
    const Visual& visual = ours.visuals[i];
    const urdf::Visual& other = *theirs.visual_array[i];
    EXPECT_TRUE(visual.pose.isApprox(pose(other.origin), 1e-15)) << ours.name;
    if (other.material) {
      EXPECT_EQ(visual.colour.value(),
                Eigen::Vector3f(other.material->color.r, other.material->color.g, other.material->color.b));
    }
    if (auto* mesh = dynamic_cast<urdf::Mesh*>(other.geometry.get())) {
      EXPECT_EQ(visual.kind, Visual::Kind::mesh);
      EXPECT_EQ(visual.mesh, mesh->filename);
      EXPECT_EQ(visual.size, vector(mesh->scale));
    } else if (auto* box = dynamic_cast<urdf::Box*>(other.geometry.get())) {
      EXPECT_EQ(visual.kind, Visual::Kind::box);
      EXPECT_EQ(visual.size, vector(box->dim));
    } else if (auto* cylinder = dynamic_cast<urdf::Cylinder*>(other.geometry.get())) {
      EXPECT_EQ(visual.kind, Visual::Kind::cylinder);
      EXPECT_EQ(visual.size, Eigen::Vector3d(cylinder->radius, cylinder->radius, cylinder->length));
    } else {
      EXPECT_EQ(visual.kind, Visual::Kind::sphere);
      EXPECT_EQ(visual.size[0], dynamic_cast<urdf::Sphere&>(*other.geometry).radius);
    }
  }
}

void expect_same(const Joint& ours, const RobotModel& model, const urdf::Joint& theirs) {
  constexpr int kTypes[] = {urdf::Joint::FIXED, urdf::Joint::REVOLUTE, urdf::Joint::CONTINUOUS,
                            urdf::Joint::PRISMATIC};
  EXPECT_EQ(kTypes[static_cast<int>(ours.kind)], theirs.type) << ours.name;
  EXPECT_EQ(model.links[ours.parent].name, theirs.parent_link_name);
  EXPECT_EQ(model.links[ours.child].name, theirs.child_link_name);
  EXPECT_TRUE(ours.origin.isApprox(pose(theirs.parent_to_joint_origin_transform), 1e-15)) << ours.name;
  if (ours.kind == Joint::Kind::fixed) return;
  EXPECT_LT((ours.axis - vector(theirs.axis).normalized()).norm(), 1e-15) << ours.name;
  EXPECT_EQ(ours.effort, theirs.limits ? theirs.limits->effort : 0) << ours.name;
  EXPECT_EQ(ours.velocity, theirs.limits ? theirs.limits->velocity : 0) << ours.name;
  const bool turns = ours.kind == Joint::Kind::continuous;
  EXPECT_EQ(ours.lower, turns ? -std::numbers::pi : theirs.limits->lower) << ours.name;
  EXPECT_EQ(ours.upper, turns ? std::numbers::pi : theirs.limits->upper) << ours.name;
  ASSERT_EQ(ours.mimic >= 0, theirs.mimic != nullptr) << ours.name;
  if (ours.mimic < 0) return;
  EXPECT_EQ(model.joints[ours.mimic].name, theirs.mimic->joint_name);
  EXPECT_EQ(ours.multiplier, theirs.mimic->multiplier);
  EXPECT_EQ(ours.offset, theirs.mimic->offset);
}

void expect_same(const std::filesystem::path& path) {
  const RobotModel ours = load_urdf(path);
  const urdf::ModelInterfaceSharedPtr theirs = urdf::parseURDFFile(path.string());
  ASSERT_TRUE(theirs) << path;
  EXPECT_EQ(ours.name, theirs->getName());
  EXPECT_EQ(ours.links[0].name, theirs->getRoot()->name);
  ASSERT_EQ(ours.links.size(), theirs->links_.size());
  for (const Link& link : ours.links) expect_same(link, *theirs->getLink(link.name));
  ASSERT_EQ(ours.joints.size(), theirs->joints_.size());
  for (const Joint& joint : ours.joints) expect_same(joint, ours, *theirs->getJoint(joint.name));
}

TEST(Urdfdom, ReadsTheSame) {
  expect_same(std::filesystem::path(HBR_SOURCE_DIR) / "models/nao/nao.urdf");
  expect_same(std::filesystem::path(HBR_SOURCE_DIR) / "models/industrial/six_joint_arm.urdf");
  expect_same(std::filesystem::path(HBR_SOURCE_DIR) / "models/industrial/seven_joint_arm.urdf");
  const TestFolder folder;
  const std::string turned = R"(<origin xyz="1 -2 .5" rpy=".3 -1.2 2.5"/>)";
  expect_same(folder.write(
      "a.urdf",
      robot(R"(<material name="red"><color rgba="1 .25 0 1"/></material>)" +
            link("a", "<inertial>" + turned + R"(<mass value="2"/><inertia ixx="1" ixy=".1" ixz="-.2" iyy="2"
                iyz=".3" izz="2.5"/></inertial><visual>)" +
                          turned + R"(<geometry><box size="1 2 3"/></geometry><material name="red"/></visual>
                <visual><geometry><mesh filename="a.obj" scale="1 2 -3"/></geometry></visual>
                <visual><geometry><cylinder radius="1" length="3"/></geometry>
                <material name="blue"><color rgba="0 0 .9 1"/></material></visual>
                <visual><geometry><sphere radius="3"/></geometry></visual>)") +
            link("b", "") + link("c") + link("d") +
            joint("i", "a", "b", "continuous", R"(<axis xyz="1 2 3"/>)") +
            joint("j", "b", "c", "prismatic", R"(<limit lower="-.5" upper="2" effort="3" velocity="4"/>)") +
            joint("k", "b", "d", "revolute",
                  R"(<axis xyz="0 -1 0"/><limit upper="2" effort="3" velocity="4"/>
                     <mimic joint="j" multiplier="-2" offset=".1"/>)"))));
}

}  // namespace
}  // namespace hbr
