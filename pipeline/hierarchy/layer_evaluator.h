// The evaluator of every layer that is built on another: its genomes are executed by the layer below, and
// described by what comes of it. Where an outcome depends on where the pen was, the descriptor is stochastic:
// the geometric median of some executions, and the fitness is that of the median individual (paper, section
// 3.1).
#pragma once

#include <functional>

#include "pipeline/hierarchy/executor.h"
#include "pipeline/hierarchy/outcome.h"
#include "pipeline/qd/evaluator.h"

namespace hbr::inline hierarchy {

// A single execution of a genome is its outcome.
class SingleEvaluator final : public Evaluator {
 public:
  // Both have to outlive the evaluator; the executor repeats nothing.
  SingleEvaluator(const Executor& executor, const Outcome& outcome);
  int descriptor_size() const override { return outcome_.descriptor_size(); }
  bool deterministic() const override { return executor_.repeatable(); }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override;

 private:
  const Executor& executor_;
  const Outcome& outcome_;
};

// What the fitness of the median individual is: that of the execution nearest to the median descriptor, or
// the median of all executions' fitness.
enum class SampleFitness { kNearest, kMedian };

class SampledEvaluator final : public Evaluator {
 public:
  // Dimensions that a stochastic descriptor may have.
  static constexpr int kMaxDimensions = 4;

  // Both have to outlive the evaluator; the executor repeats as often as there are to be samples.
  SampledEvaluator(const Executor& executor, const SampledOutcome& outcome,
                   SampleFitness fitness = SampleFitness::kNearest);
  int descriptor_size() const override { return outcome_.descriptor_size(); }
  bool stochastic() const override { return true; }
  bool deterministic() const override { return executor_.repeatable(); }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override;

  // What is typical of a genome: the median of its executions, and the execution nearest to it.
  struct Typical {
    Eigen::Index row;
    int first;                // of its executions
    int execution;            // the nearest
    const float* descriptor;  // [descriptor_size]
    float uncertainty;        // mean distance of the executions to it
  };
  using Visitor = std::function<void(const Executions&, const Typical&)>;
  // Executes rows [begin, end) of genomes of one length as evaluate() does, and tells of each that asks for
  // what can be.
  void visit(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed,
             const Visitor& visitor) const;
  // Executes rows [begin, end) of genomes of one length, and tells of each that asks for what can be the
  // first of its executions.
  using EachVisitor = std::function<void(const Executions&, Eigen::Index row, int first)>;
  void visit_executions(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed,
                        const EachVisitor& visitor) const;
  // Mean fitness of the executions of each of these genomes; NaN of one that asks for what can't be.
  void mean_fitness(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed, float* out) const;

 private:
  double median_fitness(const Executions& executions, int first) const;
  // Genomes whose executions fit into the nearest cache together.
  Eigen::Index block() const { return std::max(1, 512 / executor_.repeats()); }
  template <class Visit>
  void visit_all(const Rows& genomes, const std::int32_t* lengths, Eigen::Index begin, Eigen::Index end,
                 Seed seed, Visit&& visit) const;
  template <int D, class Visit>
  void visit_block(const Rows& genomes, const std::int32_t* lengths, Eigen::Index begin, Eigen::Index end,
                   Seed seed, Visit&& visit) const;

  const Executor& executor_;
  const SampledOutcome& outcome_;
  SampleFitness fitness_;
};

}  // namespace hbr::inline hierarchy
