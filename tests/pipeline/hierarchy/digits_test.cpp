// Digits against a plain second execution and a descriptor that can be worked out by hand.
#include "pipeline/hierarchy/layers/digits.h"

#include <numeric>
#include <optional>

#include "pipeline/core/check.h"
#include "pipeline/hierarchy/layers/flat_digits.h"
#include "pipeline/hierarchy/layers/image_outcome.h"
#include "pipeline/hierarchy/layers/numbers.h"
#include "pipeline/hierarchy/trace.h"
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
  std::optional<std::vector<std::int32_t>> plain_path(
      const std::string& out_of_range, const float* genome, int triplets,
      const Eigen::Vector2d& displaced = Eigen::Vector2d::Zero()) const {
    const Eigen::Vector2d start = Eigen::Vector2d(genome[0], genome[1]) + displaced / (2 * kFrame.half_side);
    std::vector<std::int32_t> path{plain_nearest(point_elites.measures, start)};
    for (const float* g = genome + DigitDecoder::kHead; triplets > 0; g += DigitDecoder::kBlock, --triplets) {
      double x = 2.0 * g[0] - 1, y = 2.0 * g[1] - 1;  // in units of L
      const double distance = std::hypot(x, y);
      if (distance > 1 && out_of_range == "reject") return std::nullopt;
      if (distance > 1 && out_of_range == "radius") {
        x /= distance;
        y /= distance;
      }
      const int arc = plain_nearest(arc_elites.measures, Eigen::Vector3d((x + 1) / 2, (y + 1) / 2, g[2]));
      for (const auto& wanted : arc_controllers()[1].decode(kFrame, arc_elites.solution.row(arc).data()))
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

  const PencilSettings pencil{"box", 1, 4};
};

TEST_F(Digits, ADigitIsItsArcsFromItsStart) {
  const Stack stack = arcs();
  const auto ends = make_digits(digits_settings(0), {arm, &stack}),
             whole = make_digits(digits_settings(0.0128), {arm, &stack});
  const Batch batch = some_batch(100, DigitDecoder::kHead, DigitDecoder::kBlock);
  std::vector<std::uint8_t> possible(100);
  Executions at_ends, along;
  ends->executor()->execute(batch.genome, batch.length.data(), 0, 100, Seed(0), at_ends, possible.data());
  whole->executor()->execute(batch.genome, batch.length.data(), 0, 100, Seed(0), along, possible.data());
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(possible[i]);
    const std::vector<std::int32_t>&path = at_ends.way(i), &full = along.way(i);
    EXPECT_EQ(path, plain_path("radius", batch.genome.row(i).data(), 1 + i % 3));
    EXPECT_EQ(full.front(), path.front());
    EXPECT_EQ(full.back(), path.back());
    ASSERT_EQ(along.pen_down(i).size(), 1u);
    EXPECT_EQ(along.pen_down(i)[0].first, 0);
    EXPECT_EQ(along.pen_down(i)[0].width, batch.genome(i, 2));
    const Trace trace = trace_of(along, i);
    ASSERT_EQ(trace.points(), static_cast<Eigen::Index>(full.size()));
    for (std::size_t k = 0; k < full.size(); ++k) {
      Pen p;
      arm.pens(1, &trace.joints[8 * k], &p);
      EXPECT_LT((p.position.cast<float>() - Eigen::Vector2f::Map(&trace.pen[2 * k])).norm(), 1e-6);
    }
  }
}

TEST_F(Digits, TripletsBeyondTheirRange) {
  const Stack stack = arcs();
  const Halves halves;
  for (const char* name : {"radius", "axes", "reject"}) {
    SCOPED_TRACE(name);
    const auto digits = make_digits(digits_settings(0, name), {arm, &stack, &halves});
    rng = Rng(Seed(7));
    Batch batch = some_batch(200, DigitDecoder::kHead, DigitDecoder::kBlock);
    digits->evaluator().evaluate(batch, 0, 200, Seed(0));
    Executions executions;
    std::vector<std::uint8_t> possible(200);
    digits->executor()->execute(batch.genome, batch.length.data(), 0, 200, Seed(0), executions,
                                possible.data());
    int rejected = 0;
    for (int i = 0; i < 200; ++i) {
      const float* genome = batch.genome.row(i).data();
      const auto expected = plain_path(name, genome, 1 + i % 3);
      EXPECT_EQ(batch.valid[i], expected.has_value());
      EXPECT_EQ(possible[i], expected.has_value());
      std::vector<float> image(kImagePixels, 2.0f);
      digits->draw(genome, batch.length[i], image.data());
      const float ink = std::accumulate(image.begin(), image.end(), 0.0f);
      if (expected) {
        EXPECT_EQ(executions.way(i), *expected);
        EXPECT_GT(ink, 0);
        float position[2], error;
        halves.describe(1, image.data(), position, &error);
        EXPECT_EQ(batch.fitness[i], -error);
      } else {
        EXPECT_TRUE(executions.way(i).empty());
        EXPECT_EQ(ink, 0);
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

// A number is digits of layer 4, each begun elsewhere: those nearest to the latent places that it names.
TEST_F(Digits, ANumberIsItsDigitsFromLeftToRight) {
  const Halves halves;
  Stack stack = arcs();
  Elites digit_elites = some_elites(70, 12, 2, rng);
  for (int i = 0; i < 70; ++i) digit_elites.length.push_back(6 + 3 * (i % 3));
  stack.add(make_digits(digits_settings(0), {arm, &stack}), digit_elites);
  for (const int digits : {2, 3}) {
    const auto numbers = make_numbers({digits, 0, pencil}, {arm, &stack, &halves});
    const int genes = digits * 4;
    ASSERT_EQ(numbers->genome().genes(), genes);
    ASSERT_EQ(numbers->evaluator().descriptor_size(), 2 * digits);
    Batch batch(40, genes, 2 * digits);
    batch.genome = Rows::NullaryExpr(40, genes, [&] { return rng.uniform(); });
    std::fill(batch.length.begin(), batch.length.end(), genes);
    numbers->evaluator().evaluate(batch, 0, 40, Seed(0));
    Executions executions;
    std::vector<std::uint8_t> possible(40);
    numbers->executor()->execute(batch.genome, nullptr, 0, 40, Seed(0), executions, possible.data());
    const float low = digit_elites.measures.minCoeff(), high = digit_elites.measures.maxCoeff();
    for (int i = 0; i < 40; ++i) {
      EXPECT_EQ(batch.valid[i], 1);
      ASSERT_EQ(executions.pen_down(i).size(), static_cast<std::size_t>(digits));
      double error_sum = 0, overlap = 0, right_before = -1;
      std::vector<float> images(digits * kImagePixels);
      numbers->draw(batch.genome.row(i).data(), genes, images.data());
      for (int k = 0; k < digits; ++k) {
        const float* block = batch.genome.row(i).data() + 4 * k;
        const Eigen::Vector2d command(low + static_cast<double>(block[0]) * (high - low),
                                      low + static_cast<double>(block[1]) * (high - low));
        const int digit = plain_nearest(digit_elites.measures, command);
        const Eigen::Vector2d displaced =
            (Eigen::Vector2d(block[2], block[3]).array() * 2 - 1) * kFrame.half_side;
        const auto expected =
            plain_path("radius", digit_elites.solution.row(digit).data(), 1 + digit % 3, displaced);
        const auto drawn = executions.stroke(i, k);
        EXPECT_EQ(std::vector<std::int32_t>(drawn.begin(), drawn.end()), *expected);

        float position[2], error;
        halves.describe(1, &images[k * kImagePixels], position, &error);
        error_sum += static_cast<double>(error);
        EXPECT_NEAR(batch.descriptor(i, 2 * k), position[0], 1e-5);
        EXPECT_NEAR(batch.descriptor(i, 2 * k + 1), position[1], 1e-5);
        double left = 2, right = -1;
        for (const int elite : *expected) {
          left = std::min(left, static_cast<double>(point_elites.measures(elite, 0)));
          right = std::max(right, static_cast<double>(point_elites.measures(elite, 0)));
        }
        if (k > 0) overlap += std::max(0.0, right_before - left);
        right_before = right;
      }
      EXPECT_NEAR(batch.fitness[i], -error_sum / digits - overlap, 1e-5);
    }
  }
  const Stack without_digits = arcs();
  EXPECT_THROW(make_numbers({2, 0, pencil}, {arm, &without_digits}), InputError);
}

TEST_F(Digits, FlatPensOneByOne) {
  for (const char* pen : {"straight", "joints"})
    for (const char* start : {"first", "straight_arm"}) {
      SCOPED_TRACE(std::string(pen) + ", " + start);
      const FlatDigitReading reading{
          std::string(pen) == "joints" ? FlatPen::kJoints : FlatPen::kStraight,
          std::string(start) == "first" ? FlatDigitStart::kFirst : FlatDigitStart::kStraightArm};
      const FlatDigits flat(arm, kFrame, pencil, reading);
      const auto model = make_flat_digits({kFrame.half_side, pen, start, 0.05, pencil}, {arm});
      const Batch batch = some_batch(30, FlatDigits::kHead, flat.block());
      std::vector<float> images(30 * kImagePixels), image(kImagePixels);
      flat.draw_digits(30, batch.genome.data(), batch.genome.cols(), batch.length.data(), images.data());
      for (int i = 0; i < 30; ++i) {
        const float* genome = batch.genome.row(i).data();
        const std::vector<float> xy = plain_pen(pen, start, genome, batch.length[i]);
        draw(xy.data(), static_cast<Eigen::Index>(xy.size() / 2), 1 + 3 * genome[0], Framing::box,
             kFrame.half_side, image.data());
        for (int p = 0; p < kImagePixels; ++p) ASSERT_NEAR(images[i * kImagePixels + p], image[p], 1e-4);
        const std::vector<Eigen::Vector2d> tips = flat.tips(genome, batch.length[i]);
        ASSERT_EQ(2 * tips.size(), xy.size());
        for (std::size_t k = 0; k < tips.size(); ++k)
          EXPECT_LT((tips[k].cast<float>() - Eigen::Vector2f::Map(&xy[2 * k])).norm(), 1e-6);
        model->draw(genome, batch.length[i], image.data());
        ASSERT_TRUE(std::equal(image.begin(), image.end(), &images[i * kImagePixels]));
      }
    }
}

TEST_F(Digits, AreJudgedByTheirImages) {
  const Stack stack = arcs();
  const Halves halves;
  const auto digits = make_digits(digits_settings(0.0128), {arm, &stack, &halves}),
             flat = make_flat_digits({kFrame.half_side, "straight", "first", 0.05, pencil},
                                     {arm, nullptr, &halves});
  EXPECT_EQ(flat_digits_of(*flat).block(), 40);
  EXPECT_THROW(flat_digits_of(*digits), InputError);
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
  check(digits->evaluator(), DigitDecoder::kHead, DigitDecoder::kBlock,
        [&](const float* g, int n, float* out) {
          const Rows genome = Eigen::Map<const Rows>(g, 1, n);
          Executions executions;
          std::uint8_t possible;
          digits->executor()->execute(genome, nullptr, 0, 1, Seed(0), executions, &possible);
          const Trace trace = trace_of(executions, 0);
          draw(trace.pen.data(), trace.points(), 1 + 3 * g[2], Framing::box, kFrame.half_side, out);
        });
  check(flat->evaluator(), FlatDigits::kHead, flat->genome().block_genes(),
        [&](const float* g, int n, float* out) {
          const std::vector<float> xy = plain_pen("straight", "first", g, n);
          draw(xy.data(), (n - 1) / 8, 1 + 3 * g[0], Framing::box, kFrame.half_side, out);
        });
}

}  // namespace
}  // namespace hbr
