#include "models/robot/plane/board_collision.h"

#include <gtest/gtest.h>

#include <numbers>

#include "models/robot/plane/clearance.h"
#include "models/robot/plane/reach.h"
#include "models/robot/plane/reach_map.h"
#include "tests/models/robot/body/chains.h"

namespace hbr {
namespace {

constexpr double kRadius = .05;  // of kBox's capsules, which end 0.05 before the joints

struct Segment {
  Eigen::Vector3d from, to;
};

// Of chains along x that turn about z.
std::vector<Segment> segments(const Eigen::VectorXd& joints) {
  std::vector<Segment> result;
  Eigen::Vector3d at(0, 0, 0);
  double heading = 0;
  for (const double q : joints) {
    heading += q;
    const Eigen::Vector3d along(std::cos(heading), std::sin(heading), 0);
    result.push_back({at + .05 * along, at + .95 * along});
    at += along;
  }
  return result;
}

Eigen::VectorXd random_joints(Rng& rng, int dof) {
  Eigen::VectorXd joints(dof);
  for (double& q : joints) q = rng.uniform(-3.f, 3.f);
  return joints;
}

DrawingPlane random_plane(Rng& rng) {
  return DrawingPlane::facing({rng.uniform(-2, 2), rng.uniform(-2, 2), rng.uniform(-.5f, .5f)},
                              rng.uniform(-3, 3), rng.uniform(-1.5f, 1.5f), rng.uniform(.2f, 2));
}

// The rule, asked of 500 points of each segment: how far inside it the deepest of them is (m, below 0:
// outside).
double depth(const Board& board, const std::vector<Segment>& links) {
  double deepest = -10;
  for (const Segment& link : links)
    for (int i = 0; i <= 500; ++i) {
      const Eigen::Vector3d p = link.from + i / 500. * (link.to - link.from);
      const Pen pen = board.plane.to_pen(p);
      const double beside = board.plane.scale * (board.half_side - pen.position.cwiseAbs().maxCoeff());
      deepest = std::max(deepest, std::min(beside, -pen.off_plane) + kRadius);
    }
  return deepest;
}

TEST(BoardCollision, IsThatOfCapsulesByBruteForce) {
  const auto body = chain({{}, {}, {}}, "0 0 1", kBox, .2);
  const BoardCollision collision(*body, body->model().link("tip"));
  Rng rng(Seed(1).child("board"));
  int collided = 0, tried = 0;
  for (int i = 0; i < 4000; ++i) {
    const Board board{random_plane(rng), rng.uniform(.1f, 1)};
    const Eigen::VectorXd joints = random_joints(rng, 3);
    const double deepest = depth(board, segments(joints));
    if (std::abs(deepest) < 2e-3) continue;
    ++tried;
    collided += deepest > 0;
    ASSERT_EQ(collision.collides(board, body->link_poses(joints)), deepest > 0) << deepest;
  }
  EXPECT_GT(collided, 400);
  EXPECT_LT(collided, tried - 400);
}

// A sphere of 0.2 m about the end of each link: the last holds the pen and may stand in the board, the one
// before may not.
TEST(BoardCollision, TheHandThatHoldsThePenIsExempt) {
  const auto hand = [](double x, double aside) {
    return chain(
        {{}, {}}, "0 0 1",
        fmt::format(R"(<visual><origin xyz="{} 0 0"/><geometry><sphere radius="0.2"/></geometry></visual>)",
                    x),
        aside);
  };
  const auto collides = [](const Body& body, double bend, double x) {
    const BoardCollision collision(body, body.model().link("tip"));
    return collision.collides({DrawingPlane::facing({x, 0, 0}, 0, 0, 1), 3},
                              body.link_poses(Eigen::Vector2d(0, bend)));
  };
  EXPECT_FALSE(collides(*hand(1, 0), 0, 2));
  EXPECT_FALSE(collides(*hand(1, 0), 0, 1.21));
  EXPECT_TRUE(collides(*hand(1, 0), 0, 1.19));
  EXPECT_TRUE(collides(*hand(1, .21), 0, 2));  // the pen's point is beside it
  EXPECT_TRUE(collides(*hand(2, 0), 3.1,
                       2));  // a sphere that another joint moves, about the tip where this one bends
}

TEST(BoardCollision, DirectionsAreThoseOfEndlessBoardsAtTheTip) {
  const auto body = chain({{}, {}}, "0 0 1", kBox, .2);
  const int tip = body->model().link("tip");
  const BoardCollision collision(*body, tip);
  Rng rng(Seed(2).child("board"));
  int free = 0;
  for (int i = 0; i < 50; ++i) {
    const Eigen::VectorXd joints = random_joints(rng, 2);
    const auto poses = body->link_poses(joints);
    const Directions directions = collision.free(poses);
    for (int k = 0; k < kDirections; ++k) {
      const Eigen::Vector3d n = direction(k);
      EXPECT_NEAR(n.norm(), 1, 1e-12);
      EXPECT_EQ(nearest_direction(n), k);
      DrawingPlane plane =
          DrawingPlane::facing(poses[tip].translation(), std::atan2(-n[1], -n[0]), std::asin(-n[2]), 1);
      ASSERT_LT((plane.normal() - n).norm(), 1e-9);
      EXPECT_NE(collision.collides({plane, 1e3}, poses), directions[k]);
      free += directions[k];
    }
  }
  EXPECT_GT(free, 500);
  EXPECT_LT(free, 50 * kDirections - 500);
}

TEST(BoardCollision, DirectionsAreSpreadEvenly) {
  Rng rng(Seed(3).child("board"));
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d unit =
        Eigen::Vector3d(rng.uniform(-1, 1), rng.uniform(-1, 1), rng.uniform(-1, 1)).normalized();
    EXPECT_GT(unit.dot(direction(nearest_direction(unit))), std::cos(.25));
  }
}

// Links in the plane x = 0 with a pen that stands out by 0.2 m: boards face them, and show them no back.
TEST(Clearance, OfMapAndReachAgreesWithTheBoard) {
  const std::string along_y =
      R"(<visual><origin xyz="0 0.5 0"/><geometry><box size="0.1 1 0.1"/></geometry></visual>)";
  const auto body = chain({{}, {}}, "1 0 0", along_y, .2);
  const int tip = body->model().link("tip");
  const Clearance clearance(*body, tip);
  Workers workers(2);
  const ReachMap map(*body, tip, clearance, 20000, 0, Seed(4), workers);
  const Reach reach(*body, tip, clearance, 2000, 0, Seed(5));
  const DrawingPlane front = DrawingPlane::facing({.2, 0, 0}, 0, 0, 1),
                     back = DrawingPlane::facing({.2, 0, 0}, std::numbers::pi, 0, 1);
  Rng rng(Seed(6).child("board"));
  for (int i = 0; i < 100; ++i) {
    const Eigen::Vector3d target(.2, rng.uniform(-1, 1), rng.uniform(-1, 1));
    EXPECT_LE(map.distance(target, nearest_direction(front.normal())), 1.001 * map.cell());
    EXPECT_GT(map.distance(target, nearest_direction(back.normal())), 10);
    const Reach::Nearest before = reach.nearest(target, {front, 3}, 8, 1e-5);
    EXPECT_LT(before.gap.norm(), 1e-5);
    EXPECT_TRUE(clearance.clear(before.joints.data(), {front, 3}));
    EXPECT_GT(reach.nearest(target, {back, 3}, 8, 1e-5).gap.norm(), 1e-4);
  }
}

}  // namespace
}  // namespace hbr
