#include "models/robot/body/chain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/robot/body/body.h"
#include "pipeline/core/random.h"
#include "tests/models/robot/body/flat_joints.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

const std::string kNaoUrdf = HBR_SOURCE_DIR "/models/nao/nao.urdf";

Chain chain_to(const RobotModel& model, const std::string& link) {
  for (Chain& chain : chains_of(model))
    if (chain.link == link) return chain;
  ADD_FAILURE() << link;
  return {};
}
double reach_of(const RobotModel& model) { return farthest_reach(chains_of(model).at(0)); }

TEST(Chain, GoesFromTheRootToEachEnd) {
  std::vector<std::string> ends;
  const RobotModel nao = load_urdf(kNaoUrdf);
  for (const Chain& chain : chains_of(nao)) ends.push_back(chain.steps[0].joint->name + " " + chain.link);
  EXPECT_THAT(ends, testing::UnorderedElementsAre("HeadYaw gaze", "LShoulderPitch l_gripper",
                                                  "RShoulderPitch r_gripper", "LHipYawPitch l_sole",
                                                  "RHipYawPitch r_sole"));
  // Nothing moves without a joint, nor behind one that is fixed.
  EXPECT_TRUE(chains_of(load(link("a"))).empty());
  EXPECT_TRUE(chains_of(load(link("a") + link("b") + at(1, "j", "a", "b", ""))).empty());
}

// Simbody has the same tips, with joints that follow, slide and are fixed.
TEST(Chain, TipsAreTheBodys) {
  const RobotModel slides =
      load(link("a") + link("b") + link("c") + link("d") + link("e") + joint("i", "a", "b", "fixed", "") +
           joint("j", "b", "c") + joint("k", "c", "d", "prismatic") +
           joint("l", "d", "e", "revolute",
                 R"(<mimic joint="j" multiplier="-2" offset=".3"/><axis xyz="1 2 0"/>
                    <limit lower="-3" upper="3" effort="1" velocity="1"/>)"));
  const RobotModel nao = load_urdf(kNaoUrdf);
  Rng rng(Seed(3).child("chain"));
  for (const RobotModel* model : {&slides, &nao})
    for (const Chain& chain : chains_of(*model)) {
      std::vector<std::string> names;
      for (const Joint* leader : chain.leaders) names.push_back(leader->name);
      const Body body(*model, names);
      for (int i = 0; i < 10; ++i) {
        std::vector<double> at;
        for (const Joint* leader : chain.leaders)
          at.push_back(std::lerp(leader->lower, leader->upper, rng.uniform_double()));
        EXPECT_LT((chain.tip_at(at) - body.position(model->link(chain.link), at.data())).norm(), 1e-12);
      }
    }
}

// NAO's hand: the arm's closed form is farthest where elbow and forearm are as straight as the limits let
// them.
TEST(Chain, ReachIsTheFarthestPoint) {
  double farthest = 0;
  for (double roll = .0349066; roll < .2; roll += 1e-6) {  // of the elbow; its yaw turns the offset upwards
    const double x = .1137 * std::cos(roll) + .105, y = .1137 * std::sin(roll), h = .01231, o = .015;
    for (const double yaw : {-2.08567, -1.5, -1., 0., 1., 1.5, 2.08567}) {
      const double b = std::cos(yaw) * y + std::sin(yaw) * h - o, c = std::sin(yaw) * y - std::cos(yaw) * h;
      farthest = std::max(farthest, std::sqrt(x * x + b * b + c * c));
    }
  }
  const RobotModel nao = load_urdf(kNaoUrdf);
  EXPECT_NEAR(farthest_reach(chain_to(nao, "r_gripper")), farthest, 1e-4);
  EXPECT_GE(farthest_reach(chain_to(nao, "r_gripper")), farthest - 1e-9);
  // Two links of 1 m whose elbow bends by no less than 90 degrees.
  const double right = std::acos(0.);
  const std::string links = link("a") + link("b") + link("c") + link("d");
  EXPECT_NEAR(reach_of(load(links + at(0, "j", "a", "b", limit(-1, 1)) +
                            at(1, "k", "b", "c", limit(right, 2)) + at(1, "f", "c", "d", ""))),
              std::sqrt(2.), 1e-9);
  // The same elbow, held there by what it follows.
  const std::string follows = fmt::format(R"(<mimic joint="j" multiplier="0" offset="{}"/>)", right);
  EXPECT_NEAR(reach_of(load(links + at(0, "j", "a", "b", limit(-1, 1)) +
                            at(1, "k", "b", "c", follows + limit(-2, 2)) + at(1, "f", "c", "d", ""))),
              std::sqrt(2.), 1e-9);
  // It bends back half as far as the other of the two that lead it, of 1 m each: the farthest is straight.
  const std::string half = R"(<mimic joint="k" multiplier="-.5"/>)";
  EXPECT_NEAR(reach_of(load(links + link("e") + at(0, "j", "a", "b", limit(-1, 1)) +
                            at(1, "k", "b", "c", limit(-1, 2)) + at(1, "l", "c", "d", half + limit(-2, 2)) +
                            at(1, "f", "d", "e", ""))),
              3, 1e-7);
}

// A slide of at most 2 m, and one that follows it and goes no farther than 0.5 m.
TEST(Chain, ReachIsThatOfJointsThatFollowWithinTheirLimits) {
  const auto slide = [](const char* name, const char* from, const char* to, const std::string& inside) {
    return fmt::format(R"(<joint name="{}" type="prismatic"><parent link="{}"/><child link="{}"/>)"
                       R"(<axis xyz="1 0 0"/>{}</joint>)",
                       name, from, to, inside);
  };
  EXPECT_NEAR(reach_of(load(link("a") + link("b") + link("c") + slide("j", "a", "b", limit(0, 2)) +
                            slide("k", "b", "c", R"(<mimic joint="j"/>)" + limit(0, .5)))),
              1, 1e-7);
}

TEST(Chain, ReachOfASlideIsAtItsEnds) {
  const auto slide = [](double lower, double upper) {
    return load(link("a") + link("b") +
                fmt::format(R"(<joint name="j" type="prismatic"><parent link="a"/><child link="b"/>)"
                            R"(<origin xyz="5 0 0"/><axis xyz="0 3 4"/>{}</joint>)",
                            limit(lower, upper)));
  };
  EXPECT_NEAR(reach_of(slide(-.5, 2)), 2, 1e-12);
  EXPECT_NEAR(reach_of(slide(-3, 2)), 3, 1e-12);
}

// As many random postures never get farther than the climb, and some come near; for joints of every kind.
TEST(Chain, ReachIsNoLessThanThatOfRandomPostures) {
  const RobotModel model =
      load(link("a") + link("b") + link("c") + link("d") + link("e") + joint("j", "a", "b") +
           joint("k", "b", "c", "continuous", R"(<axis xyz="1 0 1"/>)") +
           joint("l", "c", "d", "revolute", R"(<axis xyz="0 1 0"/><limit lower="-.2" upper=".9"/>)") +
           joint("m", "d", "e", "prismatic", R"(<axis xyz="1 1 0"/><limit lower="-.1" upper=".2"/>)"));
  const Chain chain = chains_of(model).at(0);
  double random = 0;
  for (const Eigen::Vector3d& point : reached_points(chain, 100000))
    random = std::max(random, (point - chain.base()).norm());
  EXPECT_GE(farthest_reach(chain), random);
  EXPECT_LE(farthest_reach(chain), 1.02 * random);
}

// Hundreds of joints are no more work than each needs: a sum of lengths, at once.
TEST(Chain, OfManyJointsIsAsLongAsItsLinks) {
  constexpr int kLinks = 200;
  std::string text = link("l0");
  for (int i = 1; i <= kLinks; ++i)
    text += link(fmt::format("l{}", i)) + at(i == 1 ? 0 : 1, fmt::format("j{}", i), fmt::format("l{}", i - 1),
                                             fmt::format("l{}", i), limit(-1, 1));
  EXPECT_NEAR(reach_of(load(text)), kLinks - 1, 1e-3);
}

TEST(Chain, ReachesTheSamePointsWithinItsLimits) {
  const RobotModel model = load(link("a") + link("b") + link("c") + at(0, "j", "a", "b", limit(.2, .7)) +
                                at(2, "f", "b", "c", ""));
  const Chain chain = chains_of(model).at(0);
  const auto points = reached_points(chain, 2000);
  EXPECT_EQ(points, reached_points(chain, 2000));
  double least = 9, most = -9;
  for (const Eigen::Vector3d& point : points) {
    EXPECT_NEAR(point.norm(), 2, 1e-12);
    least = std::min(least, std::atan2(point[1], point[0]));
    most = std::max(most, std::atan2(point[1], point[0]));
  }
  EXPECT_NEAR(least, .2, .01);
  EXPECT_NEAR(most, .7, .01);
  EXPECT_GE(least, .2);
  EXPECT_LE(most, .7);
}

}  // namespace
}  // namespace hbr
