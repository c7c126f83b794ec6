// Simbody bodies against chains of homogeneous matrices.
#include "models/robot/body/body.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <thread>
#include <tuple>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

using Matrix = Eigen::Matrix4d;

// Rodrigues' formula and fixed-axis roll, pitch, yaw, written out: nothing shared with the library.
Matrix turn(const Eigen::Vector3d& axis, double angle) {
  Eigen::Matrix3d k;
  k << 0, -axis[2], axis[1], axis[2], 0, -axis[0], -axis[1], axis[0], 0;
  Matrix m = Matrix::Identity();
  m.topLeftCorner<3, 3>() += std::sin(angle) * k + (1 - std::cos(angle)) * k * k;
  return m;
}
Matrix shift(double x, double y, double z) {
  Matrix m = Matrix::Identity();
  m.topRightCorner<3, 1>() << x, y, z;
  return m;
}
Matrix origin(double x, double y, double z, double roll, double pitch, double yaw) {
  return shift(x, y, z) * turn({0, 0, 1}, yaw) * turn({0, 1, 0}, pitch) * turn({1, 0, 0}, roll);
}

// A tree with every kind of joint: a -j- b -f- c -s- d, c -m- e (m follows j), e -n- g.
std::string tree() {
  const std::string limit = R"(<limit lower="-1" upper="2" effort="1" velocity="1"/>)";
  const std::string off_centre =
      R"(<inertial><origin xyz="0.1 -0.2 0.3" rpy="0.3 0.2 0.1"/><mass value="2.5"/>)"
      R"(<inertia ixx="0.02" iyy="0.03" izz="0.04" ixy="0.001" ixz="0.002" iyz="0.003"/></inertial>)";
  return robot(link("a") + link("b", off_centre) + link("c") + link("d", off_centre) + link("e") +
               link("g", off_centre) + joint("j", "a", "b", "revolute", R"(<axis xyz="1 2 3"/>)" + limit) +
               joint("f", "b", "c", "fixed") +
               joint("s", "c", "d", "prismatic", R"(<axis xyz="0 3 4"/>)" + limit) +
               joint("m", "c", "e", "revolute",
                     R"(<axis xyz="0 1 0"/><mimic joint="j" multiplier="-2" offset="0.5"/>)" + limit) +
               joint("n", "e", "g", "continuous", R"(<axis xyz="0 0 1"/>)"));
}

struct Expected {
  Matrix b, c, d, e, g;
  Eigen::Vector3d centre;
};
Expected expected(double j, double s, double n) {
  const Matrix o = origin(.1, .2, .3, .4, .5, .6);
  Expected x;
  x.b = o * turn(Eigen::Vector3d(1, 2, 3).normalized(), j);
  x.c = x.b * o;
  x.d = x.c * o * shift(0, .6 * s, .8 * s);
  x.e = x.c * o * turn({0, 1, 0}, -2 * j + .5);
  x.g = x.e * o * turn({0, 0, 1}, n);
  const Eigen::Vector4d off(.1, -.2, .3, 1), zero(0, 0, 0, 1);
  x.centre = ((zero + x.c * zero + x.e * zero + 2.5 * (x.b + x.d + x.g) * off) / 10.5).head<3>();
  return x;
}

Body make(const std::vector<std::string>& moving, const std::map<std::string, double>& rest = {}) {
  const TestFolder folder;
  return Body(load_urdf(folder.write("tree.urdf", tree())), moving, rest);
}

TEST(Body, FollowsTheChainOfMatrices) {
  const Body body = make({"n", "j", "s"});
  EXPECT_NEAR(body.mass(), 10.5, 1e-12);
  Rng rng(Seed(1).child("body"));
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d q(rng.uniform(-3, 3), rng.uniform(-1, 2), rng.uniform(-1, 2));
    const Expected x = expected(q[1], q[2], q[0]);
    const auto poses = body.link_poses(q);
    const auto check = [&](const char* name, const Matrix& m) {
      EXPECT_LT((poses[body.model().link(name)].matrix() - m).norm(), 1e-12) << name;
    };
    check("a", Matrix::Identity());
    check("b", x.b), check("c", x.c), check("d", x.d), check("e", x.e), check("g", x.g);
    EXPECT_LT((body.centre_of_mass(q) - x.centre).norm(), 1e-12);
  }
}

TEST(Body, LockedJointsAreTheSameBodyAtRest) {
  const Body whole = make({"n", "j", "s"}), part = make({"s"}, {{"j", 0.7}, {"n", 2.}});
  EXPECT_NEAR(part.mass(), 10.5, 1e-12);
  for (const double s : {-1., .3, 2.}) {
    const auto a = whole.link_poses(Eigen::Vector3d(2, .7, s)),
               b = part.link_poses(Eigen::VectorXd::Constant(1, s));
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LT((a[i].matrix() - b[i].matrix()).norm(), 1e-12);
    EXPECT_LT((whole.centre_of_mass(Eigen::Vector3d(2, .7, s)) -
               part.centre_of_mass(Eigen::VectorXd::Constant(1, s)))
                  .norm(),
              1e-12);
  }
}

TEST(Body, RestIsBroughtWithinLimits) {
  const Body low = make({"n"}, {{"s", -50.}}), limit = make({"n"}, {{"s", -1.}});
  EXPECT_EQ(low.link_poses(Eigen::VectorXd::Zero(1))[3].matrix(),
            limit.link_poses(Eigen::VectorXd::Zero(1))[3].matrix());
}

// What turns without end stands at 4 rad where it stands at 4 - 2 pi.
TEST(Body, RestOfAContinuousJointIsBroughtIntoATurn) {
  const Body locked = make({"j", "s"}, {{"n", 4.}});
  const Eigen::Matrix4d g = locked.link_poses(Eigen::Vector2d(0, 0))[locked.model().link("g")].matrix();
  EXPECT_LT((g - expected(0, 0, 4).g).norm(), 1e-12);
  EXPECT_NEAR(make({"n"}).posture({{"n", 4.}})[0], 4 - 2 * std::numbers::pi, 1e-14);
}

TEST(Body, JointsThatFollowNarrowTheRangeOfWhatTheyFollow) {
  for (const auto& [follows, limits, lower, upper] :
       {std::tuple(R"(multiplier="2")", R"(lower="-1" upper="1")", -.5, .5),
        {R"(multiplier="-2" offset="0.5")", R"(lower="-1" upper="2")", -.75, .75},
        {R"(multiplier="0.5")", R"(lower="-1" upper="1")", -1., 1.},
        {R"(multiplier="0" offset="5")", R"(lower="-1" upper="1")", -1., 1.},
        {R"(multiplier="2")", "", -1., 1.},                           // by mistake: it moves
        {R"(multiplier="2")", R"(lower="4" upper="5")", -1., 1.}}) {  // it can't be right
    const Body body(load(link("a") + link("b") + link("c") + joint("j", "a", "b") +
                         joint("m", "b", "c", "revolute",
                               fmt::format(R"(<mimic joint="j" {}/><limit {}/>)", follows, limits))),
                    {"j"});
    EXPECT_EQ(body.lower()[0], lower) << follows << limits;
    EXPECT_EQ(body.upper()[0], upper) << follows << limits;
    EXPECT_EQ(body.posture({{"j", 1.}})[0], upper);
  }
}

TEST(Body, JacobianIsTheDifferenceQuotient) {
  const Body body = make({"n", "j", "s"});
  Rng rng(Seed(2).child("jacobian"));
  for (const char* name : {"d", "g", "b"}) {
    const int tip = body.model().link(name);
    const Eigen::Vector3d q(rng.uniform(-3, 3), rng.uniform(-1, 2), rng.uniform(-1, 2));
    Eigen::Matrix3Xd jacobian;
    body.position(tip, q.data(), &jacobian);
    for (int k = 0; k < 3; ++k) {
      Eigen::Vector3d up = q, down = q;
      up[k] += 1e-5, down[k] -= 1e-5;
      const Eigen::Vector3d slope = (body.position(tip, up.data()) - body.position(tip, down.data())) / 2e-5;
      EXPECT_LT((slope - jacobian.col(k)).norm(), 1e-8) << name << k;
    }
  }
}

TEST(Body, KnowsWhatMovesALink) {
  const Body body = make({"n", "j", "s"});
  EXPECT_EQ(body.moves(body.model().link("d")), (std::vector<bool>{false, true, true}));
  EXPECT_EQ(body.moves(body.model().link("g")), (std::vector<bool>{true, true, false}));
  EXPECT_EQ(body.moves(0), (std::vector<bool>{false, false, false}));
}

TEST(Body, ThreadsDoNotDisturbEachOther) {
  const Body body = make({"n", "j", "s"});
  const int tip = body.model().link("g"), n = 2000;
  std::vector<double> joints(3 * n);
  Rng rng(Seed(3).child("threads"));
  for (double& q : joints) q = rng.uniform(-1, 2);
  const auto ask = [&] {
    std::vector<Eigen::Vector3d> found(n);
    body.positions(tip, n, joints.data(), found.data());
    for (int i = 0; i < n; ++i) {  // by systems of Simbody's, which threads take from a pool
      found.push_back(body.centre_of_mass(Eigen::Map<const Eigen::Vector3d>(&joints[3 * i])));
      found.push_back(Eigen::Vector3d::Constant(body.mass()));
    }
    return found;
  };
  const std::vector<Eigen::Vector3d> alone = ask();
  std::vector<Eigen::Vector3d> together[4];
  std::vector<std::thread> threads;
  for (auto& out : together) threads.emplace_back([&] { out = ask(); });
  for (std::thread& thread : threads) thread.join();
  for (const auto& out : together) EXPECT_EQ(out, alone);
}

TEST(Body, RefusesJointsItCannotMove) {
  const TestFolder folder;
  const RobotModel model = load_urdf(folder.write(
      "a.urdf", robot(link("a") + link("b") + link("c") + link("d") + link("e", "") + joint("j", "a", "b") +
                      joint("f", "b", "c", "fixed") +
                      joint("m", "b", "d", "revolute",
                            R"(<mimic joint="j"/><limit lower="-1" upper="1" effort="1" velocity="1"/>)") +
                      joint("n", "d", "e"))));
  EXPECT_THROW(Body(model, {"k"}), InputError);       // unknown
  EXPECT_THROW(Body(model, {"f"}), InputError);       // fixed
  EXPECT_THROW(Body(model, {"m"}), InputError);       // mimics
  EXPECT_THROW(Body(model, {"j", "j"}), InputError);  // twice
  EXPECT_THROW(Body(model, {"j"}, {{"k", 0}}), InputError);
  EXPECT_THROW(Body(model, {"j"}, {{"n", NAN}}), InputError);
  EXPECT_NO_THROW(Body(model, {"j"}));
}

}  // namespace
}  // namespace hbr
