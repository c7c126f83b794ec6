// Digits against a plain second execution and a descriptor that can be worked out by hand.
#include "pipeline/hierarchy/digit_layer.h"

#include <numeric>
#include <optional>

#include "pipeline/core/check.h"
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

class Digits : public Layers {
 protected:
  // What the words of the profile say, one triplet after the other.
  std::optional<std::vector<std::int32_t>> plain_path(const std::string& out_of_range, const float* genome,
                                                      int triplets) const {
    std::vector<std::int32_t> path{
        plain_nearest(point_elites.measures, Eigen::Vector2d(genome[0], genome[1]))};
    for (const float* g = genome + kDigitHead; triplets > 0; g += kDigitBlock, --triplets) {
      double x = 2.0 * g[0] - 1, y = 2.0 * g[1] - 1;  // in units of L
      const double distance = std::hypot(x, y);
      if (distance > 1 && out_of_range == "reject") return std::nullopt;
      if (distance > 1 && out_of_range == "radius") {
        x /= distance;
        y /= distance;
      }
      const int arc = plain_nearest(arc_elites.measures, Eigen::Vector3d((x + 1) / 2, (y + 1) / 2, g[2]));
      for (const auto& wanted : arc_controller("turn").decode(kFrame, arc_elites.solution.row(arc).data()))
        path.push_back(plain_line_end(path.back(), plain_request(wanted)));
    }
    return path;
  }

  // The pen of a flat digit: x and y in turn, one configuration of the arm after the other.
  std::vector<float> plain_pen(const std::string& pen, const std::string& start, const float* genome,
                               int length) const {
    std::vector<Eigen::VectorXd> stops;
    if (start == "straight_arm") stops.push_back(Eigen::VectorXd::Zero(8));
    for (int at = 1; at < length; at += 8)
      stops.push_back((Eigen::Map<const Eigen::VectorXf>(genome + at, 8).cast<double>().array() - 0.5) *
                      std::numbers::pi);
    std::vector<float> xy;
    const auto visit = [&](const Eigen::VectorXd& q) {
      Pen p;
      arm.pens(1, q.data(), &p);
      xy.insert(xy.end(), {static_cast<float>(p.position.x()), static_cast<float>(p.position.y())});
    };
    visit(stops[0]);
    for (std::size_t c = 1; c < stops.size(); ++c) {
      if (pen == "joints")
        for (int s = 1; s < 8; ++s) visit(stops[c - 1] * (1 - s / 8.0) + stops[c] * (s / 8.0));
      visit(stops[c]);
    }
    return xy;
  }

  // Genomes of one, two, three, one, ... blocks.
  Batch some_batch(int size, int head, int block) {
    Batch batch(size, head + 3 * block, 2);
    batch.genome = Rows::NullaryExpr(size, head + 3 * block, [&] { return rng.uniform(); });
    for (int i = 0; i < size; ++i) batch.length[i] = head + (1 + i % 3) * block;
    return batch;
  }

  const Pencil pencil{Framing::box, 1, 4};
};

TEST_F(Digits, ADigitIsItsArcsFromItsStart) {
  const PointLayer points(point_elites, arm, kFrame);
  const LineLayer lines(line_elites, kFrame);
  const ArcLayer arcs(arc_elites, kFrame, arc_controller("turn"));
  const Hierarchy ends(points, lines, arcs, kFrame, 0), whole(points, lines, arcs, kFrame, 0.0128);
  std::vector<std::int32_t> path, full;
  for (int i = 0; i < 100; ++i) {
    const int triplets = 1 + i % 3;
    std::vector<float> genome(kDigitHead + kMostArcs * kDigitBlock);
    for (float& g : genome) g = rng.uniform();
    EXPECT_TRUE(ends.digit_path(genome.data(), kDigitHead + 3 * triplets, path));
    EXPECT_EQ(path, plain_path("radius", genome.data(), triplets));
    EXPECT_TRUE(whole.digit_path(genome.data(), kDigitHead + 3 * triplets, full));
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

TEST_F(Digits, TripletsBeyondTheirRange) {
  const PointLayer points(point_elites, arm, kFrame);
  const LineLayer lines(line_elites, kFrame);
  const ArcLayer arcs(arc_elites, kFrame, arc_controller("turn"));
  const Halves halves;
  for (const char* name : {"radius", "axes", "reject"}) {
    SCOPED_TRACE(name);
    const Hierarchy hierarchy(points, lines, arcs, kFrame, 0, out_of_range(name));
    rng = Rng(Seed(7));
    Batch batch = some_batch(200, kDigitHead, kDigitBlock);
    DigitEvaluator(hierarchy, pencil, halves).evaluate(batch, 0, 200, Seed(0));
    std::vector<std::int32_t> path;
    int rejected = 0;
    for (int i = 0; i < 200; ++i) {
      const float* genome = batch.genome.row(i).data();
      const auto expected = plain_path(name, genome, 1 + i % 3);
      EXPECT_EQ(batch.valid[i], expected.has_value());
      EXPECT_EQ(hierarchy.digit_path(genome, batch.length[i], path), expected.has_value());
      std::vector<float> image(kImagePixels, 2.0f);
      EXPECT_EQ(draw_digit(hierarchy, pencil, genome, batch.length[i], image.data()), expected.has_value());
      if (expected) {
        EXPECT_EQ(path, *expected);
        float position[2], error;
        halves.describe(1, image.data(), position, &error);
        EXPECT_EQ(batch.fitness[i], -error);
      } else {
        ++rejected;
      }
    }
    // Of one, two and three triplets, each within the disc with a chance of pi / 4.
    const double disc = std::numbers::pi / 4, kept = (disc + disc * disc + disc * disc * disc) / 3;
    if (name == std::string("reject"))
      EXPECT_NEAR(rejected / 200.0, 1 - kept, 0.1);
    else
      EXPECT_EQ(rejected, 0);
  }
}

TEST_F(Digits, FlatPensOneByOne) {
  for (const char* pen : {"straight", "joints"})
    for (const char* start : {"first", "straight_arm"}) {
      SCOPED_TRACE(std::string(pen) + ", " + start);
      const FlatDigits flat(arm, kFrame, pencil, flat_digit_reading(pen, start));
      const Batch batch = some_batch(30, FlatDigits::kHead, flat.block());
      std::vector<float> images(30 * kImagePixels), image(kImagePixels);
      flat.draw_digits(30, batch.genome.data(), batch.genome.cols(), batch.length.data(), images.data());
      for (int i = 0; i < 30; ++i) {
        const float* genome = batch.genome.row(i).data();
        const std::vector<float> xy = plain_pen(pen, start, genome, batch.length[i]);
        draw(xy.data(), static_cast<Eigen::Index>(xy.size() / 2), 1 + 3 * genome[0], Framing::box,
             kFrame.half_side, image.data());
        for (int p = 0; p < kImagePixels; ++p) ASSERT_NEAR(images[i * kImagePixels + p], image[p], 1e-4);
        flat.draw_digits(1, genome, 0, &batch.length[i], image.data());
        ASSERT_TRUE(std::equal(image.begin(), image.end(), &images[i * kImagePixels]));
      }
    }
  EXPECT_THROW(flat_digit_reading("curved", "first"), InputError);
  EXPECT_THROW(flat_digit_reading("joints", "random"), InputError);
}

TEST_F(Digits, AreJudgedByTheirImages) {
  const PointLayer points(point_elites, arm, kFrame);
  const LineLayer lines(line_elites, kFrame);
  const ArcLayer arcs(arc_elites, kFrame, arc_controller("turn"));
  const Hierarchy hierarchy(points, lines, arcs, kFrame, 0.0128);
  const Halves halves;
  const FlatDigits flat(arm, kFrame, pencil);
  std::vector<float> image(kImagePixels);
  const auto check = [&](const Evaluator& evaluator, int head, int block, auto&& draw_row) {
    Batch whole = some_batch(12, head, block), parts = whole;
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
          const std::vector<float> xy = plain_pen("straight", "first", g, n);
          draw(xy.data(), (n - 1) / 8, 1 + 3 * g[0], Framing::box, kFrame.half_side, out);
        });
}

}  // namespace
}  // namespace hbr
