// The search for a drawing plane, on robots whose reach has a closed form.
#include "models/robot/plane/find_plane.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "models/robot/plane/missing_part.h"
#include "models/robot/plane/refine_plane.h"
#include "models/robot/plane/search_plane.h"
#include "tests/models/robot/body/chains.h"

namespace hbr {
namespace {

std::vector<Eigen::Vector2d> disc(double radius, int across) {
  std::vector<Eigen::Vector2d> points;
  const double step = 2 * radius / across;
  for (int i = 0; i <= across; ++i)
    for (int j = 0; j <= across; ++j) {
      const Eigen::Vector2d p(i * step - radius, j * step - radius);
      if (p.norm() <= radius * (1 + 1e-9)) points.push_back(p);
    }
  return points;
}

TEST(ReachMap, DistancesAreThoseToTheDisc) {
  const auto body = chain({{}, {}}, "0 0 1", kThin, 1);
  const int tip = body->model().link("tip");
  const Clearance clearance(*body, tip);
  Workers workers(2);
  const ReachMap map(*body, tip, clearance, 200000, 0, Seed(1), workers);
  const int facing = nearest_direction({0, 0, -1});
  EXPECT_NEAR(map.cell(), 4. / 40, 2e-3);
  Rng rng(Seed(2).child("map"));
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector3d place(rng.uniform(-3, 3), rng.uniform(-3, 3), rng.uniform(0, 2));
    const double in_plane = std::max(0., std::hypot(place[0], place[1]) - 2);
    // From a place outside the box the way goes by the box's side, so it may be longer; never shorter.
    EXPECT_GT(map.distance(place, facing), std::hypot(in_plane, place[2] - 1) - 1.5 * map.cell());
    if (map.box().exteriorDistance(place) == std::abs(place[2] - 1)) {
      EXPECT_LT(map.distance(place, facing), in_plane + std::abs(place[2] - 1) + 1.5 * map.cell());
    }
  }
}

struct Wanted {
  BoardKind kind = BoardKind::any;
  double floor = -10;
  int seed = 1;
  int threads = 2;
};
FoundPlane found(const Body& body, const std::vector<Eigen::Vector2d>& points, const Wanted& wanted = {}) {
  const int tip = body.model().link("tip");
  const Clearance clearance(body, tip);
  Workers workers(wanted.threads);
  const Seed seed(wanted.seed);
  const ReachMap map(body, tip, clearance, 60000, .05, seed.child("map"), workers);
  const Reach reach(body, tip, clearance, 2000, .05, seed.child("reach"));
  PlaneSearchSettings settings;
  settings.refined = 3;
  return find_plane(body, BoardRules(clearance, wanted.kind, wanted.floor), map, reach, points, .5, .01,
                    settings, workers);
}

// Two links in the plane x = 0 with a pen of 1 m draw on the plane x = 1 alone, from the side of the
// links, and best before their shoulder with the drawing's radius as long as both.
TEST(FindPlane, IsThatOfThePlanarRobot) {
  const auto body = chain({{-3.5, 3.5}, {-3.5, 3.5}}, "1 0 0", kThin, 1);
  const auto points = disc(.5, 10);
  const FoundPlane best = found(*body, points);
  EXPECT_GE(best.covered, .99);
  EXPECT_NEAR(best.board.plane.scale, 2 / .5, .03 * 2 / .5);
  EXPECT_LT((best.board.plane.origin - Eigen::Vector3d(1, 0, 0)).norm(), .06);
  EXPECT_LT(best.board.plane.normal()[0], -std::cos(.02));

  const FoundPlane again = found(*body, points, {.threads = 1});
  EXPECT_EQ(again.board.plane.origin, best.board.plane.origin);
  EXPECT_EQ(again.board.plane.u, best.board.plane.u);
  EXPECT_EQ(again.board.plane.scale, best.board.plane.scale);
}

// An arm of four joints on a table: it turns, and lifts, bends and bends again.
std::shared_ptr<const Body> on_a_table() {
  const TestFolder folder;
  const auto rod = [](double length) {
    return inertial() +
           fmt::format(R"(<visual><origin xyz="0 0 {}"/><geometry><cylinder radius="0.02" length="{}"/>
                                       </geometry></visual>)",
                       length / 2, length);
  };
  const auto turns = [](const std::string& name, const std::string& from, const std::string& to, double up,
                        const std::string& axis, double limit) {
    return joint(name, from, to, "revolute",
                 fmt::format(R"(<origin xyz="0 0 {}"/><axis xyz="{}"/>
                                <limit lower="{}" upper="{}" effort="1" velocity="1"/>)",
                             up, axis, -limit, limit));
  };
  return std::make_shared<const Body>(
      load_urdf(folder.write(
          "table.urdf", robot(link("foot", rod(.1)) + link("turret", rod(.05)) + link("upper", rod(.25)) +
                              link("fore", rod(.22)) + link("hand", rod(.05)) + link("tip", "") +
                              turns("pan", "foot", "turret", .1, "0 0 1", 2) +
                              turns("lift", "turret", "upper", .05, "0 1 0", 1.8) +
                              turns("elbow", "upper", "fore", .25, "0 1 0", 2.5) +
                              turns("flex", "fore", "hand", .22, "0 1 0", 1.7) +
                              joint("pen", "hand", "tip", "fixed", R"(<origin xyz="0 0 0.1"/>)")))),
      std::vector<std::string>{"pan", "lift", "elbow", "flex"});
}

double lowest(const Board& board) {
  double z = 1e9;
  for (const double x : {-board.half_side, board.half_side})
    for (const double y : {-board.half_side, board.half_side})
      z = std::min(z, board.plane.to_robot({x, y})[2]);
  return z;
}

TEST(SearchPlanes, DifferInDirectionTheBestFirst) {
  const auto body = on_a_table();
  const int tip = body->model().link("tip");
  const Clearance clearance(*body, tip);
  Workers workers(2);
  const ReachMap map(*body, tip, clearance, 60000, .05, Seed(1), workers);
  const BoardRules rules(clearance, BoardKind::any, floor_under(*body));
  const auto boards = search_planes(map, rules, disc(.5, 6), .5, shoulder(*body), 8, workers);
  ASSERT_GE(boards.size(), 4u);
  ASSERT_LE(boards.size(), 8u);
  for (std::size_t i = 1; i < boards.size(); ++i) {
    EXPECT_LE(rules.worth(boards[i]), rules.worth(boards[i - 1]));
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_LE(boards[i].plane.normal().dot(boards[k].plane.normal()), std::cos(20 * std::numbers::pi / 180))
          << i << " " << k;
  }
}

TEST(FindPlane, IsTheSameWhateverTheSamples) {
  const auto body = on_a_table();
  const auto points = disc(.5, 8);
  std::vector<FoundPlane> all;
  for (const int seed : {1, 2, 3})
    all.push_back(found(*body, points, {.floor = floor_under(*body), .seed = seed}));
  for (const FoundPlane& plane : all) {
    EXPECT_GE(plane.covered, .99);
    EXPECT_GE(lowest(plane.board), -1e-9);
    EXPECT_EQ(board_kind(plane.board.plane), board_kind(all[0].board.plane));
    EXPECT_NEAR(plane.board.plane.scale / all[0].board.plane.scale, 1, .03);
  }
}

TEST(FindPlane, IsOfTheKindThatIsAsked) {
  const auto body = on_a_table();
  const auto points = disc(.5, 8);
  for (const BoardKind kind : {BoardKind::level, BoardKind::upright, BoardKind::leaning}) {
    const FoundPlane plane = found(*body, points, {.kind = kind, .floor = 0});
    EXPECT_EQ(board_kind(plane.board.plane), kind);
    EXPECT_GE(plane.covered, .99);
    EXPECT_GE(lowest(plane.board), -1e-9);
    EXPECT_GT(plane.board.plane.scale, .2);
  }
  // All of it stands on what is above everything that it reaches.
  EXPECT_THROW(found(*body, points, {.floor = 2}), InputError);
}

// One joint, and two that turn about the same axis, draw circles.
TEST(ReachMap, RefusesJointsThatMoveTheTipAlongACurve) {
  Workers workers(1);
  for (const auto& body : {chain({{}}), chain({{0, 0}, {}})}) {
    const Clearance clearance(*body, body->model().link("tip"));
    EXPECT_THROW(ReachMap(*body, body->model().link("tip"), clearance, 1000, 0, Seed(1), workers),
                 InputError);
  }
}

TEST(FindPlane, CoverageComesFirst) {
  EXPECT_TRUE(better({{}, 1, .5}, {{}, .98, .6}));
  EXPECT_TRUE(better({{}, 1, .6}, {{}, 1, .5}));
  EXPECT_TRUE(better({{}, .9, .5}, {{}, .8, .6}));
}

// A shoulder that turns from 0 (to the left, along y) up to 180 degrees and an elbow that is all but stiff: a
// half ring of radius 2.
struct Half {
  std::shared_ptr<const Body> body;
  std::vector<double> distances;
};
Half half(const DrawingPlane& plane, const std::vector<Eigen::Vector2d>& points, double lower, double upper) {
  Half result{chain({{lower, upper}, {-3.5, 3.5}}, "1 0 0", kThin), {}};
  const int tip = result.body->model().link("tip");
  const Clearance clearance(*result.body, tip);
  const Reach reach(*result.body, tip, clearance, 4000, 0, Seed(5));
  Workers workers(2);
  result.distances = distances_to_reach({plane, 0}, reach, points, workers);
  return result;
}

// The upper arm may point to the upper half alone: of the disc, what lies more than 1 m from all of that
// half's elbows is missing.
TEST(Coverage, IsTheBlockedRobotsOwn) {
  const DrawingPlane plane = DrawingPlane::facing({0, 0, 0}, 0, 0, 4);  // seen along x: y is to the left
  const auto points = disc(.5, 24);
  const double pi = std::numbers::pi;
  const auto expected = [&](double lower, double upper) {  // of the shoulder, from the left upwards
    std::vector<double> distances;
    for (const Eigen::Vector2d& p : points) {
      const Eigen::Vector2d target(-4 * p[0], 4 * p[1]);  // y, z
      double least = 10;
      for (int i = 0; i <= 2000; ++i) {
        const double angle = lower + (upper - lower) * i / 2000;
        const double to_elbow = (target - Eigen::Vector2d(std::cos(angle), std::sin(angle))).norm();
        least = std::min(least, std::abs(to_elbow - 1));
      }
      distances.push_back(least);
    }
    return distances;
  };
  for (const auto& [lower, upper, missed] :
       {std::tuple(0., pi, "the bottom"), std::tuple(-pi / 4, pi / 4, "the right"),
        std::tuple(-pi, -pi / 2, "the top")}) {
    const Half blocked = half(plane, points, lower, upper);
    const std::vector<double> known = expected(lower, upper);
    for (std::size_t i = 0; i < points.size(); ++i)
      EXPECT_NEAR(blocked.distances[i], known[i], 5e-3) << points[i].transpose();
    EXPECT_TRUE(missing_part(points, blocked.distances, .02).starts_with(missed))
        << missing_part(points, blocked.distances, .02);
  }
}

// Left and right exchanged: of the body, the plane and the points.
TEST(Coverage, OfTheMirroredRobotIsMirrored) {
  const double pi = std::numbers::pi;
  const auto points = disc(.5, 16);
  std::vector<Eigen::Vector2d> mirrored;
  for (const Eigen::Vector2d& p : points) mirrored.push_back({-p[0], p[1]});
  const DrawingPlane plane = DrawingPlane::facing({.1, .3, -.2}, .2, .1, 3.6),
                     mirror = DrawingPlane::facing({.1, -.3, -.2}, -.2, .1, 3.6);
  // An angle from the left upwards becomes one from the right upwards.
  const Half left = half(plane, points, .1, 1.4), right = half(mirror, mirrored, pi - 1.4, pi - .1);
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(left.distances[i], right.distances[i], 5e-3) << points[i].transpose();
}

TEST(MissingPart, NamesRegionsByCountWithTheFarthestOfEach) {
  std::vector<Eigen::Vector2d> points;
  std::vector<double> distances;
  const auto distance = [](int i, int j) {
    if (i < 5 && j < 4) return .012;
    if (i > 55) return j > 55 ? .0034 : j < 3 ? .006 : 0;
    return 0.;
  };
  for (int i = 0; i < 60; ++i)
    for (int j = 0; j < 60; ++j) {
      points.push_back({i / 59., j / 59.});
      distances.push_back(distance(i, j));
    }
  const std::string left = "the lower left: 20 of 3 600 points, up to 12 mm away";
  const std::string right = "; the lower right: 12 of 3 600 points, up to 6 mm away";
  EXPECT_EQ(missing_part(points, distances, .001),
            left + "; the upper right: 16 of 3 600 points, up to 3.4 mm away" + right);
  EXPECT_EQ(missing_part(points, distances, .005), left + right);
  EXPECT_EQ(missing_part(points, distances, .006), left);  // as far as the tolerance is within it
  EXPECT_EQ(missing_part(points, distances, .02), "");
  EXPECT_EQ(missing_part({}, {}, .02), "");
}

}  // namespace
}  // namespace hbr
