// The recursion against Simbody's places, mass matrix and inverse dynamics. Compiled as Simbody's headers
// want it (tests/CMakeLists.txt).
#include "models/robot/body/motion_tree.h"

#include <Eigen/Cholesky>
#include <memory>

#include "models/robot/body/motion.h"
#include "models/robot/body/servos.h"
#include "models/robot/body/simbody_system.h"
#include "pipeline/core/random.h"
#include "tests/models/robot/body/rods.h"

namespace hbr {
namespace {

Equations by_simbody(SimbodySystem& body, const SystemPlan& plan, const Eigen::VectorXd& joints,
                     const Eigen::VectorXd& speeds, const Eigen::Vector3d& gravity) {
  body.pose(plan, joints.data());
  SimTK::State& state = body.state;
  const std::size_t n = plan.parts.size();
  for (std::size_t i = 0; i < n; ++i)
    if (body.slots[i] >= 0)
      state.updU()[body.slots[i]] = plan.parts[i].multiplier * speeds[plan.parts[i].coordinate];
  body.system.realize(state, SimTK::Stage::Velocity);

  SimTK::Vector_<SimTK::SpatialVec> forces(body.matter.getNumBodies());
  forces = SimTK::SpatialVec(SimTK::Vec3(0), SimTK::Vec3(0));
  for (std::size_t i = 0; i < n; ++i) {
    const SimTK::Vec3 weight = plan.parts[i].mass * vec3(gravity),
                      arm = body.bodies[i].getBodyRotation(state) * vec3(plan.parts[i].centre);
    forces[body.bodies[i].getMobilizedBodyIndex()] = {arm % weight, weight};
  }
  SimTK::Vector none(state.getNU()), residual;
  none = 0;
  SimTK::Matrix mass;
  body.matter.calcResidualForceIgnoringConstraints(state, none, forces, none, residual);
  body.matter.calcM(state, mass);

  Equations out{Eigen::MatrixXd::Zero(joints.size(), joints.size()), Eigen::VectorXd::Zero(joints.size())};
  for (std::size_t i = 0; i < n; ++i) {
    if (body.slots[i] < 0) continue;
    const Part& a = plan.parts[i];
    out.bias[a.coordinate] += a.multiplier * residual[body.slots[i]];
    for (std::size_t k = 0; k < n; ++k)
      if (body.slots[k] >= 0)
        out.mass(a.coordinate, plan.parts[k].coordinate) +=
            a.multiplier * plan.parts[k].multiplier * mass(body.slots[i], body.slots[k]);
  }
  return out;
}

// By the joints, of a point of a part.
Eigen::Matrix3Xd slopes_by_simbody(SimbodySystem& body, const SystemPlan& plan, const Eigen::VectorXd& joints,
                                   int part, const Eigen::Vector3d& point) {
  body.pose(plan, joints.data());
  SimTK::Matrix_<SimTK::Vec3> by_speed;
  body.matter.calcStationJacobian(
      body.state, SimTK::Array_<SimTK::MobilizedBodyIndex>(1, body.bodies[part].getMobilizedBodyIndex()),
      SimTK::Array_<SimTK::Vec3>(1, vec3(point)), by_speed);
  Eigen::Matrix3Xd slopes = Eigen::Matrix3Xd::Zero(3, joints.size());
  for (std::size_t i = 0; i < plan.parts.size(); ++i)
    if (body.slots[i] >= 0)
      slopes.col(plan.parts[i].coordinate) += plan.parts[i].multiplier * eigen(by_speed(0, body.slots[i]));
  return slopes;
}

// A robot with all joints that move mass, standing on a link; "": on its root.
struct Case {
  Case(const RobotModel& model, const std::vector<std::string>& joints, const std::string& ground)
      : body(model, joints, {}, ground), plan{join_parts(model, joints, {})} {
    if (!ground.empty()) {
      const int link = model.link(ground);
      plan.ground = plan.places[link].part;
      plan.pose = body.link_poses(body.posture({}))[link] * plan.places[link].pose.inverse();
    }
    simbody = std::make_unique<SimbodySystem>(model, plan);
  }
  Eigen::VectorXd random(Rng& rng, double size) const {
    Eigen::VectorXd x(body.dof());
    for (double& xi : x) xi = rng.uniform(-size, size);
    return x;
  }

  Body body;
  SystemPlan plan;
  std::unique_ptr<SimbodySystem> simbody;
};

void expect_simbodys(const RobotModel& model, const std::vector<std::string>& joints,
                     const std::string& ground, const Eigen::Vector3d& gravity) {
  Case robot(model, joints, ground);
  Rng rng(Seed(3).child(ground));
  for (int trial = 0; trial < 50; ++trial) {
    const Eigen::VectorXd q = robot.random(rng, 3), v = robot.random(rng, 5);
    Equations found;
    robot.body.equations(q, v, gravity, found);
    const Equations expected = by_simbody(*robot.simbody, robot.plan, q, v, gravity);
    EXPECT_LT((found.mass - expected.mass).norm(), 1e-11 * expected.mass.norm()) << ground;
    EXPECT_LT((found.bias - expected.bias).norm(), 1e-11 * expected.bias.norm()) << ground;
    const std::vector<Eigen::Isometry3d> poses = robot.body.link_poses(q);
    for (int link = 0; link < static_cast<int>(poses.size()); ++link) {
      const Parts::Place& place = robot.plan.places[link];
      const Eigen::Isometry3d simbodys =
          eigen(robot.simbody->bodies[place.part].getBodyTransform(robot.simbody->state)) * place.pose;
      EXPECT_LT((poses[link].matrix() - simbodys.matrix()).norm(), 1e-13) << ground << link;
      Eigen::Matrix3Xd slopes;
      const Eigen::Vector3d found_place = robot.body.position(link, q.data(), &slopes);
      EXPECT_LT((found_place - poses[link].translation()).norm(), 1e-13) << ground << link;
      EXPECT_EQ(found_place, robot.body.position(link, q.data())) << ground << link;
      EXPECT_LT(
          (slopes - slopes_by_simbody(*robot.simbody, robot.plan, q, place.part, place.pose.translation()))
              .norm(),
          1e-12)
          << ground << link;
    }
  }
}

std::vector<std::string> with_mass(const RobotModel& model) { return joints_with_inertia(model, {}, 1e-6); }

class MotionTrees : public RodsTest {
 protected:
  const RobotModel nao_ = load_urdf(HBR_SOURCE_DIR "/models/nao/nao.urdf");
};

TEST_F(MotionTrees, EquationsAreSimbodys) {
  expect_simbodys(nao_, with_mass(nao_), "", kGravity);
  expect_simbodys(nao_, with_mass(nao_), "l_sole", {1, -2, 3});
  const RobotModel arm = load_urdf(HBR_SOURCE_DIR "/models/industrial/six_joint_arm.urdf");
  expect_simbodys(arm, arm.independent_joints(), "", kGravity);
}

TEST_F(MotionTrees, SlidingAndFollowingJointsToo) {
  const RobotModel model = load(
      link("base", kRod) + link("one", kRod) + link("two", kRod) + link("three", kRod) + link("four", kRod) +
      swinging("a", "base", "one", "0.1 0 0.2") +
      R"(<joint name="b" type="prismatic"><parent link="one"/><child link="two"/>
         <origin xyz="0.1 0.2 -0.3" rpy="0.3 -0.7 1.1"/><axis xyz="0.6 0 0.8"/>
         <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>)" +
      swinging("c", "two", "three", "0 0.1 -0.6", R"(<mimic joint="a" multiplier="-1.5" offset="0.2"/>)") +
      R"(<joint name="d" type="prismatic"><parent link="two"/><child link="four"/><origin xyz="0.3 0 0"/>
         <axis xyz="0 1 0"/><mimic joint="b" multiplier="0.5"/>
         <limit lower="-3" upper="3" effort="1" velocity="1"/></joint>)");
  for (const char* ground : {"", "base", "one", "two", "three", "four"})
    expect_simbodys(model, {"a", "b"}, ground, kGravity);
}

// NAO on one foot, falling, each by its own equations: after half a second every joint stands where Simbody's
// does.
TEST_F(MotionTrees, MovementsAreSimbodysStepByStep) {
  Case robot(nao_, with_mass(nao_), "l_sole");
  const Eigen::VectorXd torques = Eigen::VectorXd::Constant(robot.body.dof(), 0.01);
  const double step = 1e-4;
  Eigen::VectorXd q = robot.body.posture({}), v = Eigen::VectorXd::Zero(robot.body.dof());
  Motion motion(robot.body, q, v);
  for (int i = 0; i < 2000; ++i) {
    const Equations e = by_simbody(*robot.simbody, robot.plan, q, v, kGravity);
    v += step * e.mass.llt().solve(torques - e.bias);
    q += step * v;
    motion.step(torques, step);
    ASSERT_LT((motion.joints() - q).cwiseAbs().maxCoeff(), 1e-9) << i;
  }
  EXPECT_GT((q - robot.body.posture({})).norm(), 0.1);  // it moved
}

}  // namespace
}  // namespace hbr
