#include "models/robot/plane/posture_path.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/models/robot/plane/random_points.h"

namespace hbr {
namespace {

const double kLimit = three_links().upper()[0];

const PointLayer& points() {
  static const PointLayer layer = random_layer(three_links(), 600);
  return layer;
}

Trace along(const Eigen::Vector2d& from, const Eigen::Vector2d& to, int n) {
  return along(points(), from, to, n);
}

// All configurations that bring the tip to a place, the first joint on a grid: two for the other joints each.
std::vector<Eigen::Vector3d> all_inverse(const Eigen::Vector3d& target) {
  std::vector<Eigen::Vector3d> all;
  const RobotOnPlane& robot = three_links();
  for (int i = 0; i <= 500; ++i) {
    const Eigen::Vector3d straight(kLimit * (i / 250.0 - 1), 0, 0);
    const Eigen::Vector3d elbow = robot.body().position(robot.body().model().link("link1"), straight.data());
    const double far = (target - elbow).norm();
    if (far > 2 || far < 1e-9) continue;
    // Two links of 1 m: half the opening, and the direction relative to the first link's.
    const double half = std::acos(far / 2);
    const Eigen::Vector3d along = (elbow -
                                   robot.body().position(robot.body().model().link("link0"), straight.data()))
                                      .normalized(),
                          to = (target - elbow).normalized();
    const double turn = std::atan2(along.y() * to.z() - along.z() * to.y(), along.dot(to));
    for (const double side : {-1.0, 1.0}) {
      const double second = std::remainder(turn + side * half, 2 * std::numbers::pi);
      const Eigen::Vector3d q(straight[0], second, -side * 2 * half);
      if (q.cwiseAbs().maxCoeff() <= kLimit) all.push_back(q);
    }
  }
  return all;
}

// The shortest way through all of them.
double brute_force(const Trace& trace) {
  std::vector<Eigen::Vector3d> before;
  std::vector<double> travel;
  for (Eigen::Index k = 0; k < trace.points(); ++k) {
    const std::vector<Eigen::Vector3d> here =
        all_inverse(three_links().plane().to_robot({trace.pen[2 * k], trace.pen[2 * k + 1]}));
    std::vector<double> shortest(here.size(), k == 0 ? 0 : std::numeric_limits<double>::infinity());
    for (std::size_t to = 0; to < here.size(); ++to)
      for (std::size_t from = 0; from < before.size(); ++from)
        shortest[to] = std::min(shortest[to], travel[from] + (here[to] - before[from]).norm());
    before = here;
    travel = shortest;
  }
  return *std::ranges::min_element(travel);
}

void expect_draws(const Trace& trace, const std::vector<double>& joints,
                  const RobotOnPlane& robot = three_links()) {
  ASSERT_EQ(joints.size(), trace.joints.size());
  for (Eigen::Index k = 0; k < trace.points(); ++k) {
    const Eigen::Vector3d target = robot.plane().to_robot({trace.pen[2 * k], trace.pen[2 * k + 1]});
    const double* held = &joints[k * robot.dof()];
    EXPECT_LE((robot.body().position(robot.tip(), held) - target).norm(), kTolerance / 10);
    for (Eigen::Index i = 0; i < robot.dof(); ++i) {
      EXPECT_GE(held[i], robot.lower()[i]);
      EXPECT_LE(held[i], robot.upper()[i]);
    }
    EXPECT_TRUE(robot.clear(held, kFrame.half_side));
  }
}

TEST(PosturePath, InverseSolutionsOfTheTestAreSolutions) {
  const Eigen::Vector3d target(0, 1.2, 0.7);
  const auto all = all_inverse(target);
  ASSERT_GT(all.size(), 100u);
  for (const Eigen::Vector3d& q : all)
    EXPECT_LT((three_links().body().position(three_links().tip(), q.data()) - target).norm(), 1e-9);
}

TEST(PosturePath, IsNearlyTheShortestOfAll) {
  for (const auto& [from, to] : {std::pair{Eigen::Vector2d(1, -1), Eigen::Vector2d(1.4, 1.2)},
                                 {Eigen::Vector2d(-1.5, 0.5), Eigen::Vector2d(0.5, 1.8)}}) {
    const Trace trace = along(from, to, 25);
    const std::vector<double> found = least_travel(three_links(), points(), trace);
    expect_draws(trace, found);
    EXPECT_LT(joint_travel(found, 3), joint_travel(trace.joints, 3) / 5);
    EXPECT_LT(joint_travel(found, 3), 1.1 * brute_force(trace));
  }
}

double largest_step(const std::vector<double>& joints, Eigen::Index dof) {
  double largest = 0;
  for (std::size_t at = 0; at + 2 * dof <= joints.size(); at += dof)
    largest = std::max(largest, joint_travel({joints.begin() + at, joints.begin() + at + 2 * dof}, dof));
  return largest;
}

// A turn that the way asks for is spread over its places, not made at one of them: between two of them the
// pen would leave its line.
TEST(PosturePath, MakesNoJumps) {
  Rng rng(Seed(10));
  double worst = 0;
  for (int trial = 0; trial < 12; ++trial) {
    const auto random = [&] { return Eigen::Vector2d(rng.uniform(-2.5f, 2.5f), rng.uniform(-2.5f, 2.5f)); };
    const Trace trace = along(random(), random(), 40);
    const std::vector<double> found = least_travel(three_links(), points(), trace);
    expect_draws(trace, found);
    worst = std::max(worst, largest_step(found, 3));
    EXPECT_GT(largest_step(trace.joints, 3), 1);
  }
  EXPECT_LT(worst, 0.6);
}

// To the left the elites hold the arm bent one way, to the right the other way: what passes from one side to
// the other without a jump is carried from place to place.
TEST(PosturePath, CarriesPosturesPastElitesThatHoldTheArmOtherwise) {
  const RobotOnPlane& robot = three_links();
  for (const double side : {-1.0, 1.0}) {
    const Elites elites = random_elites(robot, 4000, [&](const Eigen::VectorXd& q) {
      Pen pen;
      robot.pens(1, q.data(), &pen);
      return side * pen.position[0] * q[1] > 0 && q[1] * q[2] > 0;
    });
    const PointLayer layer(elites, robot, kFrame);
    ASSERT_GT(layer.size(), 500);
    const Trace trace = along(layer, {-1.8, 0.6}, {1.8, 0.6}, 40);
    const std::vector<double> found = least_travel(robot, layer, trace);
    expect_draws(trace, found);
    EXPECT_LT(largest_step(found, 3), 0.4);
  }
}

// Two links, which hold a place in two ways. To the left the elites have one of them, which the shoulder's
// limit forbids to the right: the other is to be carried back to where no elite has it.
TEST(PosturePath, HoldsTheArmFromTheStartAsItMustInTheEnd) {
  const RobotOnPlane robot("two", chain({Turn{-3.2, 2.4}, Turn{}}, "1 0 0", kBeside), "tip",
                           DrawingPlane::facing({0, 0, 0}, 0, 0, 1), kTolerance);
  const Elites elites = random_elites(robot, 4000, [&](const Eigen::VectorXd& q) {
    Pen pen;
    robot.pens(1, q.data(), &pen);
    return pen.position[0] > 0.2 || q[1] < 0;
  });
  const PointLayer layer(elites, robot, kFrame);
  for (const double height : {0.3, 0.6, 0.9}) {
    const Trace trace = along(layer, {-1.2, height}, {1.2, height}, 60);
    const std::vector<double> found = least_travel(robot, layer, trace);
    expect_draws(trace, found, robot);
    EXPECT_LT(largest_step(found, 2), 1) << height;
  }
}

// Joints whose limits bind, and the same robot, layer and traces in a mirror, where upper limits are lower
// ones.
TEST(PosturePath, AlongLimitsIsThatOfTheMirroredRobot) {
  const auto limited = [](double sign) {
    const auto turn = [&](double a, double b) {
      return Turn{std::min(sign * a, sign * b), std::max(sign * a, sign * b)};
    };
    return RobotOnPlane("three", chain({turn(-0.5, 1.5), turn(-1.2, 0.2), turn(-0.1, 1.9)}, "1 0 0", kBeside),
                        "tip", DrawingPlane::facing({0, 0, 0}, 0, 0, 1), kTolerance);
  };
  const RobotOnPlane robot = limited(1), mirrored_robot = limited(-1);
  Elites elites = random_elites(robot, 400), mirrored_elites = elites;
  for (Eigen::Index i = 0; i < elites.size(); ++i) {
    // Genes of few digits, so that the mirrored ones are exact.
    elites.solution.row(i) = (elites.solution.row(i).array() * 4096).round() / 4096;
    mirrored_elites.solution.row(i) = 1 - elites.solution.row(i).array();
    perform_point(robot, kFrame, elites, i);
    perform_point(mirrored_robot, kFrame, mirrored_elites, i);
  }
  const PointLayer layer(elites, robot, kFrame), mirrored_layer(mirrored_elites, mirrored_robot, kFrame);
  int at_limits = 0;
  for (std::int32_t elite = 0; elite + 1 < 40; ++elite) {
    const Trace trace = along(layer, layer.position(elite), layer.position(elite + 1), 12);
    Trace mirrored_trace = trace;
    for (double& joint : mirrored_trace.joints) joint = -joint;
    for (std::size_t k = 1; k < trace.pen.size(); k += 2) mirrored_trace.pen[k] *= -1;
    const std::vector<double> found = least_travel(robot, layer, trace),
                              mirrored = least_travel(mirrored_robot, mirrored_layer, mirrored_trace);
    expect_draws(trace, found, robot);
    expect_draws(mirrored_trace, mirrored, mirrored_robot);
    for (std::size_t k = 0; k < found.size(); ++k) {
      EXPECT_NEAR(found[k], -mirrored[k], 1e-6);
      at_limits += found[k] == robot.lower()[k % 3] || found[k] == robot.upper()[k % 3];
    }
  }
  EXPECT_GT(at_limits, 2);
}

// Links 0.3 m thick, beside their board: folded, the last would lie in the first.
TEST(PosturePath, StaysClearOfTheRobot) {
  const std::string looks =
      R"(<visual><origin xyz="0 0.5 0"/><geometry><box size="0.3 1 0.3"/></geometry></visual>)";
  const RobotOnPlane thick("thick", chain({Turn{}, Turn{}, Turn{}}, "1 0 0", looks, 0.5), "tip",
                           DrawingPlane::facing({0.5, 0, 0}, 0, 0, 1), kTolerance);
  const PointLayer layer = random_layer(thick, 600);
  ASSERT_LT(layer.size(), 590);
  Rng rng(Seed(11));
  for (int trial = 0; trial < 12; ++trial) {
    const auto random = [&] { return Eigen::Vector2d(rng.uniform(-1.2f, 1.2f), rng.uniform(-1.2f, 1.2f)); };
    const Trace trace = along(layer, random(), random(), 20);
    const std::vector<double> found = least_travel(thick, layer, trace);
    EXPECT_LT(joint_travel(found, 3), joint_travel(trace.joints, 3));
    for (std::size_t at = 0; at < found.size(); at += 3)
      EXPECT_TRUE(thick.clear(&found[at], kFrame.half_side));
  }
}

// The second differences of a way that is as short as its places allow are small: of one that only goes from
// candidate to candidate they are not.
TEST(PosturePath, IsStraightAsAWhole) {
  const PointLayer layer = random_layer(three_links(), 12);
  double bends = 0, steps = 0;
  for (std::int32_t elite = 0; elite + 1 < 12; ++elite) {
    Trace trace;  // away from elites: straight between two of them
    for (int k = 0; k < 30; ++k) {
      const Eigen::Vector2d p =
          layer.position(elite) + (layer.position(elite + 1) - layer.position(elite)) * k / 29.;
      const std::int32_t near = layer.nearest(p);
      trace.pen.insert(trace.pen.end(), {static_cast<float>(p.x()), static_cast<float>(p.y())});
      trace.joints.insert(trace.joints.end(), layer.joints(near), layer.joints(near) + 3);
    }
    const std::vector<double> found = least_travel(three_links(), layer, trace);
    const auto at = [&](int k) { return Eigen::Vector3d(&found[3 * k]); };
    for (int k = 1; k + 1 < 30; ++k) {
      bends += (at(k + 1) - 2 * at(k) + at(k - 1)).norm();
      steps += (at(k + 1) - at(k)).norm();
    }
  }
  EXPECT_LT(bends, 0.15 * steps);
}

TEST(PosturePath, IsNeverLongerThanTheTraces) {
  Rng rng(Seed(9));
  for (int trial = 0; trial < 10; ++trial) {
    const auto random = [&] { return Eigen::Vector2d(rng.uniform(-2, 2), rng.uniform(-2, 2)); };
    const Trace trace = along(random(), random(), 2 + trial);
    const std::vector<double> found = least_travel(three_links(), points(), trace);
    expect_draws(trace, found);
    EXPECT_LE(joint_travel(found, 3), joint_travel(trace.joints, 3) + 1e-12);
    EXPECT_EQ(least_travel(three_links(), points(), trace), found);  // the same again
  }
}

TEST(PosturePath, APointIsItself) {
  const Trace point = along({1, 1}, {1, 1}, 2);
  Trace one{{point.pen[0], point.pen[1]}, {point.joints.begin(), point.joints.begin() + 3}};
  EXPECT_EQ(least_travel(three_links(), points(), one), one.joints);
  EXPECT_EQ(joint_travel(one.joints, 3), 0);
  EXPECT_NEAR(joint_travel({0, 0, 0, 3, 4, 0, 3, 4, 2}, 3), 7, 1e-12);
}

}  // namespace
}  // namespace hbr
