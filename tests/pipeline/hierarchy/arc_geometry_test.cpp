#include "pipeline/hierarchy/layers/arc_geometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"
#include "pipeline/hierarchy/layers/digits.h"
#include "tests/support/frame.h"

namespace hbr {
namespace {

ArcPoints on_circle(const Eigen::Vector2d& centre, double radius, double from, double step) {
  ArcPoints points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double angle = from + step * static_cast<double>(i);
    points[i] = centre + radius * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  }
  return points;
}

TEST(CircleCentre, FindsTheCircleThatThePointsAreOn) {
  Rng rng(Seed(22));
  for (int i = 0; i < 1000; ++i) {
    const Eigen::Vector2d centre(rng.uniform(-0.6f, 0.6f), rng.uniform(-0.6f, 0.6f));
    const double radius = rng.uniform(0.02f, 0.6f);
    const ArcPoints points = on_circle(centre, radius, rng.uniform(-3, 3), rng.uniform(0.2f, 1.5f));
    EXPECT_LT((circle_centre(points) - centre).norm(), 1e-3 * radius);  // the ridge's pull
  }
}

TEST(CircleCentre, FitsNoisyPointsInTheLeastSquares) {
  // At the minimum of sum (|p - c|^2 - k)^2 the gradient vanishes; the ridge is 1e-6 of the spread.
  Rng rng(Seed(23));
  ArcPoints points = on_circle({0.1, -0.2}, 0.3, 0.5, 0.7);
  for (auto& p : points) p += Eigen::Vector2d(rng.uniform(-.03f, .03f), rng.uniform(-.03f, .03f));
  const Eigen::Vector2d c = circle_centre(points);
  const auto cost = [&](const Eigen::Vector2d& at) {
    double mean = 0, sum = 0;
    for (const auto& p : points) mean += (p - at).squaredNorm() / 6;
    for (const auto& p : points) sum += std::pow((p - at).squaredNorm() - mean, 2);
    return sum;
  };
  for (int d = 0; d < 8; ++d)
    EXPECT_LT(cost(c), cost(c + 1e-4 * Eigen::Vector2d(std::cos(d * 0.7854), std::sin(d * 0.7854))));
}

TEST(CircleCentre, CollinearAndEqualPointsStayFinite) {
  ArcPoints line, same;
  for (int i = 0; i < 6; ++i) {
    line[i] = Eigen::Vector2d(0.1, 0.2) + 0.05 * i * Eigen::Vector2d(0.6, 0.8);
    same[i] = Eigen::Vector2d(0.3, -0.1);
  }
  EXPECT_LT((circle_centre(line) - (line[0] + line[5]) / 2).norm(), 1e-3);
  EXPECT_LT((circle_centre(same) - same[0]).norm(), 1e-12);
}

TEST(ArcShape, ARegularArcHasNoIrregularity) {
  const ArcPoints arc = on_circle({0.2, 0.1}, 0.25, 1.0, 0.5);  // headings pass pi
  const ArcShape shape = arc_shape(arc);
  EXPECT_LT(irregularity(arc), 1e-20);
  EXPECT_NEAR(shape.length, 5 * 2 * 0.25 * std::sin(0.25), 1e-12);
  EXPECT_LT((shape.centre - (Eigen::Vector2d(0.2, 0.1) - on_circle({0.2, 0.1}, 0.25, 1.0, 0.5)[0])).norm(),
            1e-4);
}

TEST(ArcShape, IrregularityByHand) {
  // A right-angled staircase: lengths 1, 2, 1, 2, 1, turns +90, -90, +90, -90 degrees.
  const ArcPoints stairs{{{0, 0}, {1, 0}, {1, 2}, {2, 2}, {2, 4}, {3, 4}}};
  const double length_variance = 0.24, turn = std::numbers::pi / 2;
  EXPECT_NEAR(irregularity(stairs), 100 * length_variance + turn * turn, 1e-12);
  EXPECT_EQ(arc_shape(stairs).length, 7);
}

TEST(ArcDescriptor, BringsFarCentresBackAlongTheirDirection) {
  const Eigen::Vector3d d = arc_descriptor(kFrame, {{3, -4}, 0.5});
  const Eigen::Vector2d centre = kFrame.point(d.head<2>());
  EXPECT_LT((centre - kFrame.half_side * Eigen::Vector2d(0.6, -0.8)).norm(), 1e-12);
  EXPECT_NEAR(d.z(), 0.5 / 1.28, 1e-12);
  EXPECT_EQ(arc_descriptor(kFrame, {{0, 0}, 99}), Eigen::Vector3d(0.5, 0.5, 1));
}

TEST(DecodeArc, CentresBeyondTheirRange) {
  const float corner[3] = {1, 0, 0.25f}, inside[3] = {0.75f, 0.5f, 1};
  const auto centre = [](OutOfRange range, const float* genes) {
    return kFrame.point(decode_arc(kFrame, range, genes).value().head<2>());
  };
  const Eigen::Vector2d direction(1, -1);
  EXPECT_LT((centre(OutOfRange::kRadius, corner) - kFrame.half_side * direction.normalized()).norm(), 1e-12);
  EXPECT_LT((centre(OutOfRange::kAxes, corner) - kFrame.half_side * direction).norm(), 1e-12);
  EXPECT_FALSE(decode_arc(kFrame, OutOfRange::kReject, corner));
  for (const OutOfRange all : {OutOfRange::kRadius, OutOfRange::kAxes, OutOfRange::kReject}) {
    EXPECT_LT((centre(all, inside) - Eigen::Vector2d(kFrame.half_side / 2, 0)).norm(), 1e-12);
    EXPECT_EQ(decode_arc(kFrame, all, inside)->z(), 1);
  }
}

TEST(ArcShape, ACentroidIsTheMeanOfThePoints) {
  const ArcPoints arc = on_circle({0.2, 0.1}, 0.25, 1.0, 0.5);
  Eigen::Vector2d mean(0, 0);
  for (const auto& p : arc) mean += p / 6;
  const ArcShape shape = arc_shape(arc, ArcCentre::kCentroid);
  EXPECT_LT((shape.centre - (mean - arc[0])).norm(), 1e-15);
  EXPECT_EQ(shape.length, arc_shape(arc).length);
}

TEST(ArcShape, FivePointsMakeAnArcOfFourSegments) {
  const ArcPoints arc = on_circle({0.2, 0.1}, 0.25, 1.0, 0.5);
  const std::span<const Eigen::Vector2d> tail = std::span(arc).subspan(1);
  EXPECT_LT((arc_shape(tail).centre - (Eigen::Vector2d(0.2, 0.1) - arc[1])).norm(), 1e-4);
  EXPECT_NEAR(arc_shape(tail).length, 4 * 2 * 0.25 * std::sin(0.25), 1e-12);
  EXPECT_LT(irregularity(tail), 1e-20);
}

TEST(Irregularity, OfTurnsWithoutTheirSense) {
  // Turns of +90, -90, +90, -90 degrees: all the same without their sense.
  const ArcPoints stairs{{{0, 0}, {1, 0}, {1, 1}, {2, 1}, {2, 2}, {3, 2}}};
  EXPECT_LT(irregularity(stairs, {true, false}), 1e-20);
  // +90, +90, -90, -90: lengths alike, and again.
  const ArcPoints hook{{{0, 0}, {1, 0}, {1, 1}, {0, 1}, {0, 2}, {1, 2}}};
  EXPECT_LT(irregularity(hook, {true, false}), 1e-20);
  EXPECT_NEAR(irregularity(hook), std::pow(std::numbers::pi / 2, 2), 1e-12);
}

TEST(Irregularity, OfSegmentsOfNoLength) {
  // North, still, north, still, north: turns of 90 degrees to the x-axis and back, or none at all.
  const ArcPoints halting{{{0, 0}, {0, 1}, {0, 1}, {0, 2}, {0, 2}, {0, 3}}};
  const double lengths = 100 * 0.24, turn = std::numbers::pi / 2;
  EXPECT_NEAR(irregularity(halting), lengths + turn * turn, 1e-12);
  EXPECT_NEAR(irregularity(halting, {false, true}), lengths, 1e-12);
}

TEST(Irregularity, TurnsAreTheShortWayRound) {
  // Headings 170, -170, 170, -170, 170 degrees: turns of +20 and -20.
  ArcPoints zigzag{Eigen::Vector2d(0, 0)};
  for (int k = 0; k < 5; ++k) {
    const double heading = (k % 2 ? -170 : 170) * std::numbers::pi / 180;
    zigzag[k + 1] = zigzag[k] + Eigen::Vector2d(std::cos(heading), std::sin(heading));
  }
  EXPECT_NEAR(irregularity(zigzag), std::pow(20 * std::numbers::pi / 180, 2), 1e-12);
}

TEST(ArcDescriptors, ManyAreTheSameAsOneByOne) {
  Rng rng(Seed(28));
  constexpr int kCount = 37;
  ArcTracks tracks;
  tracks.resize(kCount);
  std::vector<ArcPoints> arcs(kCount);
  for (int s = 0; s < kCount; ++s)
    for (int k = 0; k <= kArcSegments; ++k) {
      tracks.x[k][s] = s == 5 ? 0.1f : rng.uniform();
      tracks.y[k][s] = s == 5 ? 0.2f : rng.uniform();
      arcs[s][k] = 2 * kFrame.half_side * Eigen::Vector2d(tracks.x[k][s], tracks.y[k][s]);
    }
  Eigen::Matrix<float, kCount, 3> descriptors;  // a coordinate after the other
  float* const coordinates[3] = {descriptors.col(0).data(), descriptors.col(1).data(),
                                 descriptors.col(2).data()};
  for (const ArcCentre centre : {ArcCentre::kCircle, ArcCentre::kCentroid}) {
    arc_descriptors(kFrame, centre, tracks, kCount, coordinates);
    for (int s = 0; s < kCount; ++s)
      EXPECT_EQ(Eigen::Vector3f(descriptors.row(s)),
                arc_descriptor(kFrame, arc_shape(arcs[s], centre)).cast<float>());
  }
}

}  // namespace
}  // namespace hbr
