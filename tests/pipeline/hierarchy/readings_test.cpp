// Readings of what the paper leaves open about executions, each against its words.
#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "tests/pipeline/hierarchy/layers.h"

namespace hbr {
namespace {

class Readings : public Layers {
 protected:
  // Arcs of random genomes as `settings` say, and where each execution stopped: [genome][sample][stop].
  struct Arcs {
    Batch batch{0, 0, 0};
    std::vector<std::vector<std::vector<int>>> stops;
    std::vector<std::vector<double>> fitness;
  };
  Arcs execute(const ArcsSettings& how, Seed seed) {
    const Stack stack = lines();
    const auto arcs = make_arcs(how, {arm, &stack});
    Rng genes{Seed(3)};
    Arcs result;
    result.batch = Batch(kGenomes, 3, 3);
    result.batch.genome = Rows::NullaryExpr(kGenomes, 3, [&] { return genes.uniform(); });
    arcs->evaluator().evaluate(result.batch, 0, kGenomes, seed);
    const ArcOutcome& outcome = arc_outcome(*arcs);
    const SampledEvaluator evaluator(*arcs->executor(), outcome);
    evaluator.visit(result.batch.genome, 0, kGenomes, seed,
                    [&](const Executions& executions, const SampledEvaluator::Typical& typical) {
                      auto& stops = result.stops.emplace_back();
                      auto& fitness = result.fitness.emplace_back();
                      for (int s = 0; s < how.samples; ++s) {
                        stops.emplace_back();
                        for (int k = 0; k < executions.stops(); ++k)
                          stops.back().push_back(executions.stop(k)[typical.first + s]);
                        fitness.push_back(outcome.fitness(executions, typical.first + s));
                      }
                    });
    return result;
  }
  Eigen::Vector2d request(const float* genome, int line) const {
    return plain_request(arc_controllers()[1].decode(kFrame, genome)[line]);
  }

  static constexpr int kGenomes = 40;
  ArcsSettings settings = arcs_settings("turn", 8);
};

TEST_F(Readings, LinesCountFromWhereTheLastWasToEnd) {
  settings.way_points = "commanded";
  const Arcs arcs = execute(settings, Seed(31));
  int differ = 0;
  for (int i = 0; i < kGenomes; ++i)
    for (const std::vector<int>& stops : arcs.stops[i]) {
      Eigen::Vector2f commanded = point_elites.measures.row(stops[0]).transpose();
      int closed = stops[0];
      for (int k = 1; k <= kArcSegments; ++k) {
        const Eigen::Vector2d line = request(arcs.batch.genome.row(i).data(), k - 1);
        commanded += (line / (2 * kFrame.half_side)).cast<float>();
        ASSERT_EQ(stops[k], plain_nearest(point_elites.measures, commanded.cast<double>()));
        closed = plain_line_end(closed, line);
      }
      differ += closed != stops.back();
    }
  EXPECT_GT(differ, kGenomes);  // the other reading comes elsewhere
}

TEST_F(Readings, TheWayOfAnOpenLoopBeginsWhereTheLastLineWasToEnd) {
  const Stack stack = points();
  Executions executions;
  const double spacing = 0.02;
  executions.begin(stack.points(), 1, {true, spacing, WayPoints::kCommanded});
  const Eigen::Vector2d place(0.11, 0.23), line(0.1, -0.05);
  executions.set_origin(0, {0.01, -0.02});
  executions.put_down(0, place, 0.5f);
  std::vector<std::int32_t> expected = executions.way(0);
  ASSERT_EQ(expected.size(), 1u);
  Eigen::Vector2d from = place + Eigen::Vector2d(0.01, -0.02);
  EXPECT_EQ(expected[0], plain_nearest(point_elites.measures, kFrame.point_descriptor(from)));
  const Eigen::Vector2f step = kFrame.point_step(line);
  const std::int32_t which = 0;
  for (int k = 0; k < 2; ++k, from += line) {
    executions.displace(executions.all(), {&line, &step[0], &step[1], 1}, &which);
    const int parts = static_cast<int>(std::ceil(line.norm() / spacing));
    for (int part = 1; part <= parts; ++part)
      expected.push_back(plain_nearest(point_elites.measures,
                                       kFrame.point_descriptor(from + line * (double(part) / parts))));
  }
  expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
  EXPECT_EQ(executions.way(0), expected);
}

TEST_F(Readings, StartsAreWhereDrawnJointsBringThePen) {
  settings.start.starts = "joints";
  const Arcs arcs = execute(settings, Seed(32));
  for (int i = 0; i < kGenomes; ++i) {
    Rng joints(Seed(32).child(i));
    for (const std::vector<int>& stops : arcs.stops[i]) {
      Eigen::VectorXd angles(arm.dof());
      for (double& angle : angles) angle = (joints.uniform() - 0.5) * std::numbers::pi;
      Pen pen;
      arm.pens(1, angles.data(), &pen);
      ASSERT_EQ(stops[0], plain_nearest(point_elites.measures, kFrame.point_descriptor(pen.position)));
    }
  }
}

TEST_F(Readings, CommonStartsAreTheSameForAllGenomesAndGenerations) {
  for (const char* from : {"elites", "joints"}) {
    settings.start = {from, "common"};
    const Arcs one = execute(settings, Seed(33)), other = execute(settings, Seed(34));
    std::set<std::vector<int>> sets;
    for (const Arcs* arcs : {&one, &other})
      for (const auto& samples : arcs->stops) {
        std::vector<int> starts;
        for (const std::vector<int>& stops : samples) starts.push_back(stops[0]);
        sets.insert(starts);
      }
    ASSERT_EQ(sets.size(), 1u) << from;
    EXPECT_GT(std::set<int>(sets.begin()->begin(), sets.begin()->end()).size(), 5u) << from;
    EXPECT_EQ(one.batch.fitness, other.batch.fitness);
  }
}

TEST_F(Readings, TheMedianFitnessHasAsManySamplesAboveAsBelow) {
  for (const int samples : {1, 2, 7, 8}) {
    settings.samples = samples;
    settings.sample_fitness = "median";
    const Arcs median = execute(settings, Seed(35));
    settings.sample_fitness = "nearest";
    const Arcs nearest = execute(settings, Seed(35));
    EXPECT_EQ(median.batch.descriptor, nearest.batch.descriptor);
    for (int i = 0; i < kGenomes; ++i) {
      std::vector<double> sorted = median.fitness[i];
      std::ranges::sort(sorted);
      const double expected = (sorted[(samples - 1) / 2] + sorted[samples / 2]) / 2;
      EXPECT_FLOAT_EQ(median.batch.fitness[i], static_cast<float>(expected)) << samples;
      EXPECT_THAT(nearest.fitness[i], testing::Contains(testing::DoubleNear(nearest.batch.fitness[i], 1e-5)));
    }
    EXPECT_EQ(median.batch.fitness == nearest.batch.fitness, samples == 1);
  }
}

}  // namespace
}  // namespace hbr
