#include "models/robot/body/simbody_system.h"

namespace hbr::inline robots {
namespace {

SimTK::Transform transform(const Eigen::Isometry3d& t) {
  SimTK::Mat33 m;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) m(r, c) = t.linear()(r, c);
  return {SimTK::Rotation(m), vec3(t.translation())};
}

SimTK::MassProperties mass_properties(const Part& part) {
  const Eigen::Matrix3d& i = part.inertia_origin;
  return {part.mass, vec3(part.centre),
          SimTK::Inertia(SimTK::SymMat33(i(0, 0), i(1, 0), i(1, 1), i(2, 0), i(2, 1), i(2, 2)))};
}

}  // namespace

Eigen::Isometry3d eigen(const SimTK::Transform& t) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) result.linear()(r, c) = t.R().row(r)[c];
  result.translation() = eigen(t.p());
  return result;
}

SimbodySystem::SimbodySystem(const RobotModel& model, const SystemPlan& plan) : bodies(plan.parts.size()) {
  const auto n = static_cast<int>(plan.parts.size());
  std::vector<int> mobilised(n, -1);  // of each part's joint: the part that it moves here
  std::vector<int> grown{plan.ground};
  bodies[plan.ground] =
      SimTK::MobilizedBody::Weld(matter.Ground(), transform(plan.pose),
                                 SimTK::Body::Rigid(mass_properties(plan.parts[plan.ground])), {});
  for (std::size_t next = 0; next < grown.size(); ++next) {
    const int from = grown[next];
    const auto grow = [&](int joint_of, int to) {
      if (mobilised[joint_of] >= 0) return;
      mobilised[joint_of] = to;
      bodies[to] = mobilise(model, plan, joint_of, from, to);
      grown.push_back(to);
    };
    if (plan.parts[from].parent >= 0) grow(from, plan.parts[from].parent);
    for (int child = 1; child < n; ++child)
      if (plan.parts[child].parent == from) grow(child, child);
  }
  state = system.realizeTopology();
  system.realizeModel(state);
  for (const int moved : mobilised)
    slots.push_back(moved < 0 ? -1 : static_cast<int>(bodies[moved].getFirstQIndex(state)));
}

// Part `to`, hung on part `from` by the joint of one of the two.
SimTK::MobilizedBody SimbodySystem::mobilise(const RobotModel& model, const SystemPlan& plan, int joint_of,
                                             int from, int to) {
  const Part& part = plan.parts[joint_of];
  const Joint& joint = model.joints[part.joint];
  // A Pin turns about the z axis of its frames, a Slider goes along x.
  const bool slides = joint.kind == Joint::Kind::prismatic, reversed = to != joint_of;
  const SimTK::CoordinateAxis own_axis(slides ? 0 : 2);
  const SimTK::Rotation frame(SimTK::UnitVec3(vec3(joint.axis)), own_axis);
  const SimTK::Transform in_child(frame), in_parent = transform(part.origin) * in_child;
  const SimTK::Transform &inboard = reversed ? in_child : in_parent,
                         &outboard = reversed ? in_parent : in_child;
  const auto direction = reversed ? SimTK::MobilizedBody::Reverse : SimTK::MobilizedBody::Forward;
  const SimTK::Body::Rigid body(mass_properties(plan.parts[to]));
  if (slides) return SimTK::MobilizedBody::Slider(bodies[from], inboard, body, outboard, direction);
  return SimTK::MobilizedBody::Pin(bodies[from], inboard, body, outboard, direction);
}

void SimbodySystem::pose(const SystemPlan& plan, const double* joints) {
  SimTK::Vector& q = state.updQ();
  for (std::size_t i = 1; i < slots.size(); ++i) {
    const Part& part = plan.parts[i];
    q[slots[i]] = part.multiplier * joints[part.coordinate] + part.offset;
  }
  system.realize(state, SimTK::Stage::Position);
}

}  // namespace hbr::inline robots
