// Digits against a plain second execution and a descriptor that can be worked out by hand.
#include "pipeline/hierarchy/digit_layer.h"

#include <numeric>

#include "tests/pipeline/hierarchy/layers.h"

namespace hbr {
namespace {

// Ink in the upper and lower half; the error is the mean.
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
      EXPECT_NEAR(whole.fitness[i], -error, 1e-5);
      EXPECT_NEAR(whole.descriptor(i, 0), position[0], 1e-5);
      EXPECT_EQ(whole.valid[i], 1);
    }
  };
  check(DigitEvaluator(hierarchy, pencil, halves), kDigitHead, kDigitBlock,
        [&](const float* g, int n, float* out) {
          std::vector<std::int32_t> path;
          hierarchy.digit_path(g, n, path);
          const Trace trace = hierarchy.trace(path);
          draw(trace.pen.data(), trace.points(), 1 + 3 * g[2], Framing::box, kFrame.half_side, out);
        });
  check(FlatDigitEvaluator(flat, halves), FlatDigits::kHead, flat.block(),
        [&](const float* g, int n, float* out) {
          std::vector<float> pens;
          for (int c = 1; c < n; c += 8) {
            const Eigen::VectorXd q =
                (Eigen::Map<const Eigen::VectorXf>(g + c, 8).cast<double>().array() - 0.5) * std::numbers::pi;
            Pen p;
            arm.pens(1, q.data(), &p);
            pens.insert(pens.end(), {static_cast<float>(p.position.x()), static_cast<float>(p.position.y())});
          }
          draw(pens.data(), (n - 1) / 8, 1 + 3 * g[0], Framing::box, kFrame.half_side, out);
        });
}

}  // namespace
}  // namespace hbr
