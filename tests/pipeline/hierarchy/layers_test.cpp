// Points, lines and arcs against a plain second execution.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/hierarchy/geometric_median.h"
#include "pipeline/hierarchy/layers/flat_arcs.h"
#include "tests/pipeline/hierarchy/layers.h"

namespace hbr {
namespace {

TEST_F(Layers, PointsAreWhereTheArmIs) {
  const Stack stack = stack_of(arm, point_elites);
  const PointLayer& points = stack.points();
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

void displace(Executions& executions, Group group, const Eigen::Vector2d& by) {
  const Eigen::Vector2f step = kFrame.point_step(by);
  const std::vector<std::int32_t> which(group.size(), 0);
  executions.displace(group, {&by, &step.x(), &step.y(), 1}, which.data());
}

TEST_F(Layers, LinesEndAtTheEliteNearestToWhatTheyAskFor) {
  const Stack stack = points();
  Executions ends, ways;
  for (int i = 0; i < 500; ++i) {
    const auto start = static_cast<std::int32_t>(rng.below(400));
    const float genes[2] = {rng.uniform(), rng.uniform()};
    const Eigen::Vector2d d = decode_line(kFrame, genes);
    EXPECT_LE(d.norm(), kFrame.longest_line * (1 + 1e-12));
    ends.begin(stack.points(), 1);
    ways.begin(stack.points(), 1, {true, 0.0128});
    for (Executions* executions : {&ends, &ways}) {
      executions->move(executions->all(), &start);
      displace(*executions, executions->all(), d);
      ASSERT_EQ(executions->stops(), 2);
      ASSERT_EQ(executions->stop(1)[0], plain_line_end(start, d));
    }
    std::vector<std::int32_t> expected{start};
    int parts = 1;
    while (d.norm() / parts > 0.0128) ++parts;
    for (int k = 1; k <= parts; ++k) expected.push_back(plain_line_end(start, d * k / parts));
    expected.erase(std::unique(expected.begin(), expected.end()), expected.end());
    EXPECT_EQ(ways.way(0), expected);
  }
}

// Some executions go on while others stay.
TEST_F(Layers, ExecutionsMoveInGroups) {
  const Stack stack = points();
  Executions executions;
  executions.begin(stack.points(), 3, {true, 0});
  const std::int32_t begin[3] = {5, 6, 7}, some[2] = {0, 2}, to[2] = {9, 8};
  executions.move(executions.all(), begin);
  executions.move(some, to);
  const Eigen::Vector2d right(0.1, 0);
  displace(executions, Group(some, 1), right);
  EXPECT_EQ(executions.stops(), 3);
  EXPECT_EQ(std::vector<std::int32_t>(executions.stop(1), executions.stop(1) + 3),
            (std::vector<std::int32_t>{9, -1, 8}));
  const int end = plain_line_end(9, right);
  EXPECT_EQ(executions.at(0), end);
  EXPECT_EQ(executions.at(1), 6);
  EXPECT_EQ(executions.way(0), (std::vector<std::int32_t>{5, 9, end}));
  EXPECT_EQ(executions.way(1), (std::vector<std::int32_t>{6}));
  EXPECT_EQ(executions.stop(2)[2], -1);
  executions.set_origin(1, {0.1, 0.2});
  executions.put_down(1, pen(40) - Eigen::Vector2d(0.1, 0.2), 0.5f);
  EXPECT_EQ(executions.way(1), (std::vector<std::int32_t>{6, 40}));
  ASSERT_EQ(executions.pen_down(1).size(), 1u);
  EXPECT_EQ(executions.pen_down(1)[0].first, 1);
}

TEST_F(Layers, ALineIsDescribedByTheMedianOfItsExecutions) {
  const Stack stack = points();
  const auto lines = make_lines(lines_settings(25), {arm, &stack});
  Batch batch(30, 2, 2);
  batch.genome = Rows::NullaryExpr(30, 2, [&] { return rng.uniform(); });
  const Seed seed(25);
  lines->evaluator().evaluate(batch, 0, 30, seed);
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
  const Stack stack = points();
  Batch batch(30, 2, 4);
  batch.genome = Rows::NullaryExpr(30, 2, [&] { return rng.uniform(); });
  make_lines_from_start({kFrame.longest_line, "disc"}, {arm, &stack})
      ->evaluator()
      .evaluate(batch, 0, 30, Seed(26));
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector4d d = batch.descriptor.row(i).transpose().cast<double>();
    const int start = plain_nearest(point_elites.measures, d.head<2>());
    const Eigen::Vector2d v =
        pen(plain_line_end(start, decode_line(kFrame, batch.genome.row(i).data()))) - pen(start);
    EXPECT_LT((kFrame.line(d.tail<2>()) - v).norm(), 1e-6);
    EXPECT_LT((kFrame.point(d.head<2>()) - pen(start)).norm(), 1e-6);
  }
}

// The joints' part of an arc's fitness, by its definition.
double plain_joint_term(const PointLayer& points, const std::vector<int>& waypoints, JointTerm term) {
  std::vector<double> all;
  double mean_of_variances = 0;
  for (const int at : waypoints) {
    all.insert(all.end(), points.joints(at), points.joints(at) + points.dof());
    mean_of_variances += points.variance(at) / static_cast<double>(waypoints.size());
  }
  const Eigen::Map<const Eigen::ArrayXd> q(all.data(), static_cast<Eigen::Index>(all.size()));
  return term == JointTerm::kMean ? mean_of_variances : (q - q.mean()).square().mean();
}

TEST_F(Layers, AnArcIsFiveLinesThroughLayerTwo) {
  const Stack stack = lines();
  const PointLayer& points = stack.points();
  constexpr int kGenomes = 200, kSamples = 7;  // more than one block
  struct Found {
    Eigen::Vector3f descriptor;
    float uncertainty;
    double fitness;
    std::vector<int> waypoints;
  };
  for (const ArcController& controller : arc_controllers())
    for (const ArcReadingSettings& reading :
         {ArcReadingSettings{"circle", "mean"}, ArcReadingSettings{"centroid", "pooled"}}) {
      const auto arcs = make_arcs(arcs_settings(controller.name, kSamples, reading), {arm, &stack});
      const ArcOutcome outcome(kFrame, arc_reading(reading));
      const SampledEvaluator evaluator(*arcs->executor(), outcome);
      const auto genes = static_cast<int>(controller.genes(kFrame).size());
      Batch batch(kGenomes, genes, 3);
      batch.genome = Rows::NullaryExpr(kGenomes, genes, [&] { return rng.uniform(); });
      std::vector<Found> outcomes;
      std::vector<float> means(kGenomes);
      evaluator.visit(batch.genome, 0, kGenomes, Seed(27),
                      [&](const Executions& executions, const SampledEvaluator::Typical& typical) {
                        EXPECT_EQ(typical.row, static_cast<Eigen::Index>(outcomes.size()));
                        Found found{Eigen::Vector3f::Map(typical.descriptor),
                                    typical.uncertainty,
                                    outcome.fitness(executions, typical.execution),
                                    {}};
                        for (int k = 0; k < executions.stops(); ++k)
                          found.waypoints.push_back(executions.stop(k)[typical.execution]);
                        outcomes.push_back(found);
                      });
      evaluator.mean_fitness(batch.genome, 0, kGenomes, Seed(27), means.data());
      for (int i = 0; i < kGenomes; ++i) {
        const float* genome = batch.genome.row(i).data();
        Rng starts(Seed(27).child(i));
        Samples<3> descriptors;
        descriptors.resize(kSamples);
        std::vector<double> fitness;
        std::vector<std::vector<int>> visited;
        for (int s = 0; s < kSamples; ++s) {
          int at = static_cast<int>(starts.below(400));
          ArcPoints drawn{pen(at)};
          visited.push_back({at});
          for (int k = 0; k < 5; ++k) {
            at = plain_line_end(at, plain_request(controller.decode(kFrame, genome)[k]));
            drawn[k + 1] = pen(at);
            visited.back().push_back(at);
          }
          const Eigen::Vector3d d = arc_descriptor(kFrame, arc_shape(drawn, arc_reading(reading).centre));
          for (int c = 0; c < 3; ++c) descriptors.coordinate(c)[s] = static_cast<float>(d[c]);
          const std::vector<int> after(visited.back().begin() + 1, visited.back().end());
          fitness.push_back(
              -(irregularity(drawn) + plain_joint_term(points, after, arc_reading(reading).joint_term)));
        }
        const Median<3> median = geometric_median<3>(descriptors);
        EXPECT_LT((outcomes[i].descriptor - median.point).norm(), 1e-5);
        EXPECT_NEAR(outcomes[i].uncertainty, median.mean_distance, 1e-5);
        EXPECT_NEAR(outcomes[i].fitness, fitness[median.nearest], 1e-9);
        EXPECT_NEAR(means[i], std::accumulate(fitness.begin(), fitness.end(), 0.0) / kSamples, 1e-4);
        EXPECT_EQ(outcomes[i].waypoints, visited[median.nearest]);
      }

      arcs->evaluator().evaluate(batch, 60, 62, Seed(27));  // a row does not depend on its neighbours
      for (int i = 60; i < 62; ++i) {
        EXPECT_EQ(batch.descriptor.row(i).transpose(), outcomes[i].descriptor);
        EXPECT_EQ(batch.uncertainty[i], outcomes[i].uncertainty);
        EXPECT_EQ(batch.fitness[i], static_cast<float>(outcomes[i].fitness));
      }
    }
}

TEST_F(Layers, ACostOfTheJointsIsItsMeanOverTheWaypoints) {
  const Stack stack = points();
  Executions executions;
  executions.begin(stack.points(), 1);
  double cost = 0;
  for (const std::int32_t at : {7, 1, 2, 3, 4, 5}) {
    executions.move(executions.all(), &at);
    if (at != 7) cost += few_joints(stack.points().joints(at), 8) / 5;
  }
  EXPECT_NEAR(ArcOutcome::mean_joint_cost(executions, 0, joint_costs()[1]), cost, 1e-12);
}

TEST_F(Layers, TheTurnControllerAsksForARegularArc) {
  const float genes[3] = {0.3f, 0.6f, 0.55f};
  const ArcLines lines = arc_controllers()[1].decode(kFrame, genes);
  ArcPoints ideal{Eigen::Vector2d::Zero()};
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(lines[i].norm(), 0.6f * kFrame.longest_line, 1e-9);
    ideal[i + 1] = ideal[i] + lines[i];
  }
  EXPECT_LT(irregularity(ideal), 1e-12);
  EXPECT_NEAR(std::atan2(lines[0].y(), lines[0].x()), (2 * 0.3f - 1) * std::numbers::pi, 1e-9);
  const double turn =
      std::atan2(lines[0].x() * lines[1].y() - lines[0].y() * lines[1].x(), lines[0].dot(lines[1]));
  EXPECT_NEAR(turn, (2 * 0.55f - 1) * std::numbers::pi, 1e-9);
}

TEST_F(Layers, AFlatArcIsFiveConfigurations) {
  for (const FlatStart start : {FlatStart::kStraight, FlatStart::kFirst, FlatStart::kRandom})
    for (const ArcReading reading : {ArcReading{}, ArcReading{ArcCentre::kCentroid, JointTerm::kPooled}}) {
      const FlatArcEvaluator evaluator(arm, kFrame, start, reading);
      EXPECT_EQ(evaluator.deterministic(), start != FlatStart::kRandom);
      Batch batch(20, evaluator.genes(), 3);
      batch.genome = Rows::NullaryExpr(20, 40, [&] { return rng.uniform(); });
      evaluator.evaluate(batch, 0, 20, Seed(31));
      std::vector<float> irregular(20), joint(20);
      evaluator.terms(batch.genome, 0, 20, Seed(31), irregular.data(), joint.data());
      for (int i = 0; i < 20; ++i) {
        const auto configuration = [&](const Eigen::RowVectorXf& genes) {
          return Eigen::VectorXd((genes.transpose().cast<double>().array() - 0.5) * std::numbers::pi);
        };
        const auto tip = [&](const Eigen::VectorXd& q) {
          Pen p;
          arm.pens(1, q.data(), &p);
          return p.position;
        };
        std::vector<Eigen::Vector2d> drawn;
        if (start == FlatStart::kStraight) drawn.emplace_back(0.5815, 0);
        if (start == FlatStart::kRandom) {
          Rng random(Seed(31).child(i));
          Eigen::RowVectorXf genes(8);
          for (float& g : genes) g = random.uniform();
          drawn.push_back(tip(configuration(genes)));
        }
        Eigen::MatrixXd q(8, 5);
        for (int w = 0; w < 5; ++w) {
          q.col(w) = configuration(batch.genome.row(i).segment(8 * w, 8));
          drawn.push_back(tip(q.col(w)));
        }
        double cost = (q.array() - q.mean()).square().mean();
        if (reading.joint_term == JointTerm::kMean)
          cost = (q.array().rowwise() - q.colwise().mean().array()).square().mean();
        const Eigen::Vector3d d = arc_descriptor(kFrame, arc_shape(drawn, reading.centre));
        EXPECT_LT((batch.descriptor.row(i).transpose().cast<double>() - d).norm(), 1e-6);
        EXPECT_NEAR(batch.fitness[i], -(irregularity(drawn) + cost), 1e-4);
        EXPECT_NEAR(irregular[i], irregularity(drawn), 1e-4);
        EXPECT_NEAR(joint[i], cost, 1e-5);
      }
    }
}

TEST_F(Layers, ASquareKeepsItsCorners) {
  Frame square = kFrame;
  square.line_range = LineRange::kSquare;
  const float corner[2] = {1, 0};
  EXPECT_LT((decode_line(square, corner) - 0.256 * Eigen::Vector2d(1, -1)).norm(), 1e-12);
  EXPECT_LT((decode_line(kFrame, corner) - 0.256 * Eigen::Vector2d(1, -1).normalized()).norm(), 1e-12);
}

}  // namespace
}  // namespace hbr
