// The layers against a plain second execution that asks every elite for its distance.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "models/arm/planar_arm.h"
#include "pipeline/hierarchy/digit_layer.h"
#include "pipeline/hierarchy/geometric_median.h"

namespace hbr {
namespace {

constexpr Frame kFrame{0.63965, 0.256};

int plain_nearest(const Rows& measures, const Eigen::VectorXd& wanted) {
  int best = 0;
  const Eigen::VectorXf w = wanted.cast<float>();
  const auto distance = [&](int i) {
    float sum = 0;
    for (Eigen::Index d = 0; d < w.size(); ++d) sum += (measures(i, d) - w[d]) * (measures(i, d) - w[d]);
    return sum;
  };
  for (int i = 1; i < measures.rows(); ++i)
    if (distance(i) < distance(best)) best = i;
  return best;
}

Elites some_elites(int n, int genes, int d, Rng& rng) {
  Elites e;
  e.solution = Rows::NullaryExpr(n, genes, [&] { return rng.uniform(); });
  e.measures = Rows::NullaryExpr(n, d, [&] { return rng.uniform(); });
  return e;
}

class Layers : public testing::Test {
 protected:
  Layers() {
    Batch batch(400, 8, 2);
    batch.genome = Rows::NullaryExpr(400, 8, [&] { return rng.uniform(); });
    PointEvaluator(arm, kFrame, joint_variance, 0).evaluate(batch, 0, 400, Seed(0));
    point_elites.solution = batch.genome;
    point_elites.measures = batch.descriptor;
    line_elites = some_elites(200, 2, 2, rng);
    arc_elites = some_elites(300, 3, 3, rng);
  }

  Eigen::Vector2d pen(int elite) const {
    return kFrame.point(point_elites.measures.row(elite).transpose().cast<double>());
  }
  int plain_line_end(int start, const Eigen::Vector2d& displacement) const {
    return plain_nearest(point_elites.measures, kFrame.point_descriptor(pen(start) + displacement));
  }
  Eigen::Vector2d plain_request(const Eigen::Vector2d& wanted) const {
    const int i = plain_nearest(line_elites.measures, kFrame.line_descriptor(wanted));
    Eigen::Vector2d d((line_elites.solution(i, 0) - 0.5) * 2 * kFrame.longest_line,
                      (line_elites.solution(i, 1) - 0.5) * 2 * kFrame.longest_line);
    if (d.norm() > kFrame.longest_line) d *= kFrame.longest_line / d.norm();
    return d;
  }

  Rng rng{Seed(24)};
  PlanarArm arm{{.0875, .078, .072, .072, .071, .068, .068, .065}, std::numbers::pi / 2};
  Elites point_elites, line_elites, arc_elites;
};

TEST_F(Layers, PointsAreWhereTheArmIs) {
  const PointLayer points(point_elites, arm, kFrame);
  for (int i = 0; i < points.size(); ++i) {
    Pen p;
    arm.pens(1, points.joints(i), &p);
    EXPECT_LT((points.position(i) - p.position).norm(), 1e-6);
    const Eigen::Map<const Eigen::VectorXd> q(points.joints(i), 8);
    EXPECT_NEAR(points.variance(i), (q.array() - q.mean()).square().mean(), 1e-12);
    std::vector<double> squares;
    for (const double x : q) squares.push_back(x * x);
    std::sort(squares.begin(), squares.end());
    EXPECT_NEAR(few_joints(q.data(), 8), std::accumulate(squares.begin(), squares.begin() + 6, 0.0), 1e-12);
  }
}

TEST_F(Layers, LinesEndAtTheEliteNearestToWhatTheyAskFor) {
  const PointLayer points(point_elites, arm, kFrame);
  std::vector<std::int32_t> path;
  for (int i = 0; i < 500; ++i) {
    const int start = static_cast<int>(rng.below(400));
    const float genes[2] = {rng.uniform(), rng.uniform()};
    const Eigen::Vector2d d = decode_line(kFrame, genes);
    EXPECT_LE(d.norm(), kFrame.longest_line * (1 + 1e-12));
    ASSERT_EQ(line_end(points, start, d), plain_line_end(start, d));
    path.assign(1, start);
    line_path(points, start, d, 0.0128, path);
    EXPECT_EQ(path.back(), line_end(points, start, d));
    EXPECT_EQ(std::adjacent_find(path.begin(), path.end()), path.end());
    EXPECT_LE(path.size(), 2 + d.norm() / 0.0128);
  }
}

TEST_F(Layers, ALineIsDescribedByTheMedianOfItsExecutions) {
  const PointLayer points(point_elites, arm, kFrame);
  const LineEvaluator evaluator(points, kFrame, 25);
  Batch batch(30, 2, 2);
  batch.genome = Rows::NullaryExpr(30, 2, [&] { return rng.uniform(); });
  const Seed seed(25);
  evaluator.evaluate(batch, 0, 30, seed);
  for (int i = 0; i < 30; ++i) {
    Rng starts(seed.child(i));
    Samples<2> samples;
    samples.resize(25);
    for (int s = 0; s < 25; ++s) {
      const int start = static_cast<int>(starts.below(400));
      const Eigen::Vector2d v =
          pen(plain_line_end(start, decode_line(kFrame, batch.genome.row(i).data()))) - pen(start);
      samples.coordinate(0)[s] = static_cast<float>(v.x() / (2 * kFrame.longest_line) + 0.5);
      samples.coordinate(1)[s] = static_cast<float>(v.y() / (2 * kFrame.longest_line) + 0.5);
    }
    const Median<2> median = geometric_median<2>(samples);
    EXPECT_LT((batch.descriptor.row(i).transpose() - median.point).norm(), 1e-6);
    EXPECT_NEAR(batch.uncertainty[i], median.mean_distance, 1e-6);
    EXPECT_EQ(batch.fitness[i], 0);
  }
}

TEST_F(Layers, AReferenceLineIsDescribedByItsStartAndItsDisplacement) {
  const PointLayer points(point_elites, arm, kFrame);
  Batch batch(30, 2, 4);
  batch.genome = Rows::NullaryExpr(30, 2, [&] { return rng.uniform(); });
  LineFromStartEvaluator(points, kFrame).evaluate(batch, 0, 30, Seed(26));
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector4d d = batch.descriptor.row(i).transpose().cast<double>();
    const int start = plain_nearest(point_elites.measures, d.head<2>());
    const Eigen::Vector2d v =
        pen(plain_line_end(start, decode_line(kFrame, batch.genome.row(i).data()))) - pen(start);
    EXPECT_LT((kFrame.line(d.tail<2>()) - v).norm(), 1e-6);
    EXPECT_LT((kFrame.point(d.head<2>()) - pen(start)).norm(), 1e-6);
  }
}

TEST_F(Layers, AnArcIsFiveLinesThroughLayerTwo) {
  const PointLayer points(point_elites, arm, kFrame);
  const LineLayer lines(line_elites, kFrame);
  for (const char* name : {"lines", "turn"}) {
    const ArcController controller = arc_controller(name);
    const ArcEvaluator evaluator(points, lines, kFrame, controller, 7);
    for (int i = 0; i < 50; ++i) {
      std::vector<float> genome(controller.genes);
      for (float& g : genome) g = rng.uniform();
      Rng execution(Seed(27).child(i)), again(Seed(27).child(i));
      const ArcEvaluator::Outcome outcome = evaluator.execute(genome.data(), execution);

      Samples<3> descriptors;
      descriptors.resize(7);
      std::vector<double> fitness;
      for (int s = 0; s < 7; ++s) {
        int at = static_cast<int>(again.below(400));
        ArcPoints drawn{pen(at)};
        double variance = 0;
        for (int k = 0; k < 5; ++k) {
          at = plain_line_end(at, plain_request(controller.decode(kFrame, genome.data())[k]));
          drawn[k + 1] = pen(at);
          variance += points.variance(at) / 5;
        }
        const ArcShape shape = arc_shape(drawn);
        const Eigen::Vector3d d = arc_descriptor(kFrame, shape);
        for (int c = 0; c < 3; ++c) descriptors.coordinate(c)[s] = static_cast<float>(d[c]);
        fitness.push_back(-(irregularity(drawn) + variance));
      }
      const Median<3> median = geometric_median<3>(descriptors);
      EXPECT_LT((outcome.descriptor - median.point).norm(), 1e-6);
      EXPECT_NEAR(outcome.fitness(), fitness[median.nearest], 1e-9);
    }
  }
}

TEST_F(Layers, TheTurnControllerAsksForARegularArc) {
  const float genes[3] = {0.3f, 0.6f, 0.55f};
  const ArcLines lines = arc_controller("turn").decode(kFrame, genes);
  ArcPoints ideal{Eigen::Vector2d::Zero()};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(lines[i].norm(), 0.6f * kFrame.longest_line, 1e-9);
    ideal[i + 1] = ideal[i] + lines[i];
  }
  EXPECT_LT(irregularity(ideal), 1e-12);
  EXPECT_NEAR(std::atan2(lines[0].y(), lines[0].x()), (2 * 0.3f - 1) * std::numbers::pi, 1e-9);
}

TEST_F(Layers, AFlatArcStartsAtTheStraightArm) {
  const FlatArcEvaluator evaluator(arm, kFrame);
  Batch batch(20, evaluator.genes(), 3);
  batch.genome = Rows::NullaryExpr(20, 40, [&] { return rng.uniform(); });
  evaluator.evaluate(batch, 0, 20, Seed(0));
  for (int i = 0; i < 20; ++i) {
    ArcPoints drawn{Eigen::Vector2d(0.5815, 0)};
    double variance = 0;
    for (int w = 0; w < 5; ++w) {
      Eigen::VectorXd q =
          (batch.genome.row(i).segment(8 * w, 8).transpose().cast<double>().array() - 0.5) * std::numbers::pi;
      Pen p;
      arm.pens(1, q.data(), &p);
      drawn[w + 1] = p.position;
      variance += (q.array() - q.mean()).square().mean() / 5;
    }
    const ArcShape shape = arc_shape(drawn);
    EXPECT_LT((batch.descriptor.row(i).transpose().cast<double>() - arc_descriptor(kFrame, shape)).norm(),
              1e-6);
    EXPECT_NEAR(batch.fitness[i], -(irregularity(drawn) + variance), 1e-4);
  }
}

// A descriptor that can be worked out by hand: ink in the upper and lower half; the error is the mean.
class Halves final : public Descriptor {
 public:
  const Eigen::VectorXf& lower() const override { return lower_; }
  const Eigen::VectorXf& upper() const override { return upper_; }
  void describe(Eigen::Index n, const float* images, float* position, float* error) const override {
    for (Eigen::Index i = 0; i < n; ++i) {
      const float* image = images + i * kImagePixels;
      const auto mean = [&](int from, int to) {
        return std::accumulate(image + from, image + to, 0.0f) / static_cast<float>(to - from);
      };
      position[2 * i] = mean(0, kImagePixels / 2);
      position[2 * i + 1] = mean(kImagePixels / 2, kImagePixels);
      error[i] = mean(0, kImagePixels);
    }
  }

 private:
  Eigen::VectorXf lower_ = Eigen::VectorXf::Zero(2), upper_ = Eigen::VectorXf::Ones(2);
};

TEST_F(Layers, ADigitIsItsArcsFromItsStart) {
  const PointLayer points(point_elites, arm, kFrame);
  const LineLayer lines(line_elites, kFrame);
  const ArcLayer arcs(arc_elites, kFrame, arc_controller("turn"));
  const Hierarchy ends(points, lines, arcs, kFrame, 0), whole(points, lines, arcs, kFrame, 0.0128);
  std::vector<std::int32_t> path, full;
  for (int i = 0; i < 100; ++i) {
    const int triplets = 1 + i % 3;
    std::vector<float> genome(kDigitHead + kMostArcs * kDigitBlock);
    for (float& g : genome) g = rng.uniform();
    std::vector<std::int32_t> expected{
        plain_nearest(point_elites.measures, Eigen::Vector2d(genome[0], genome[1]))};
    for (int t = 0; t < triplets; ++t) {
      const int arc = plain_nearest(arc_elites.measures, decode_arc(kFrame, &genome[kDigitHead + 3 * t]));
      for (const auto& wanted : arc_controller("turn").decode(kFrame, arc_elites.solution.row(arc).data()))
        expected.push_back(plain_line_end(expected.back(), plain_request(wanted)));
    }
    ends.digit_path(genome.data(), kDigitHead + 3 * triplets, path);
    EXPECT_EQ(path, expected);
    whole.digit_path(genome.data(), kDigitHead + 3 * triplets, full);
    EXPECT_EQ(full.front(), path.front());
    EXPECT_EQ(full.back(), path.back());
    const Trace trace = whole.trace(full);
    ASSERT_EQ(trace.points(), static_cast<Eigen::Index>(full.size()));
    for (std::size_t k = 0; k < full.size(); ++k) {
      Pen p;
      arm.pens(1, &trace.joints[8 * k], &p);
      EXPECT_LT((p.position.cast<float>() - Eigen::Vector2f::Map(&trace.pen[2 * k])).norm(), 1e-6);
    }
  }
}

TEST_F(Layers, DigitsAreJudgedByTheirImages) {
  const PointLayer points(point_elites, arm, kFrame);
  const LineLayer lines(line_elites, kFrame);
  const ArcLayer arcs(arc_elites, kFrame, arc_controller("turn"));
  const Hierarchy hierarchy(points, lines, arcs, kFrame, 0.0128);
  const Pencil pencil{Framing::box, 1, 4};
  const Halves halves;
  const FlatDigits flat(arm, kFrame, pencil);
  std::vector<float> image(kImagePixels);
  const auto check = [&](const Evaluator& evaluator, int head, int block, auto&& draw_row) {
    Batch whole(12, head + 3 * block, 2);
    whole.genome = Rows::NullaryExpr(12, head + 3 * block, [&] { return rng.uniform(); });
    for (int i = 0; i < 12; ++i) whole.length[i] = head + (1 + i % 3) * block;
    Batch parts = whole;
    evaluator.evaluate(whole, 0, 12, Seed(0));
    evaluator.evaluate(parts, 0, 5, Seed(0));
    evaluator.evaluate(parts, 5, 12, Seed(0));
    EXPECT_EQ(whole.descriptor, parts.descriptor);
    EXPECT_EQ(whole.fitness, parts.fitness);
    for (int i = 0; i < 12; ++i) {
      draw_row(whole.genome.row(i).data(), whole.length[i], image.data());
      float position[2], error;
      halves.describe(1, image.data(), position, &error);
      EXPECT_GT(error, 0);
      EXPECT_EQ(whole.fitness[i], -error);
      EXPECT_EQ(whole.descriptor(i, 0), position[0]);
      EXPECT_EQ(whole.valid[i], 1);
    }
  };
  check(DigitEvaluator(hierarchy, pencil, halves), kDigitHead, kDigitBlock,
        [&](const float* g, int n, float* out) { draw_digit(hierarchy, pencil, g, n, out); });
  check(FlatDigitEvaluator(flat, halves), FlatDigits::kHead, flat.block(),
        [&](const float* g, int n, float* out) { flat.draw_digit(g, n, out); });
}

}  // namespace
}  // namespace hbr
