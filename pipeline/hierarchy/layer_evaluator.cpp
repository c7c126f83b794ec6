#include "pipeline/hierarchy/layer_evaluator.h"

#include <algorithm>
#include <limits>

#include "pipeline/core/check.h"
#include "pipeline/hierarchy/geometric_median.h"

namespace hbr::inline hierarchy {

SingleEvaluator::SingleEvaluator(const Executor& executor, const Outcome& outcome)
    : executor_(executor), outcome_(outcome) {
  HBR_CHECK(executor.repeats() == 1, "{} executions for one outcome", executor.repeats());
}

void SingleEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const {
  thread_local Executions executions;
  executor_.execute(batch.genome, batch.length.data(), begin, end, seed, executions, &batch.valid[begin]);
  // Rows of a batch are contiguous, and so are these results.
  outcome_.measure(executions, batch.descriptor.row(begin).data(), &batch.fitness[begin]);
}

SampledEvaluator::SampledEvaluator(const Executor& executor, const SampledOutcome& outcome,
                                   SampleFitness fitness)
    : executor_(executor), outcome_(outcome), fitness_(fitness) {
  HBR_CHECK(outcome.descriptor_size() <= kMaxDimensions, "a stochastic descriptor of {} dimensions",
            outcome.descriptor_size());
}

void SampledEvaluator::evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const {
  std::fill(batch.valid.begin() + begin, batch.valid.begin() + end, std::uint8_t{0});
  visit_all(batch.genome, batch.length.data(), begin, end, seed,
            [&](const Executions& executions, const Typical& typical) {
              std::copy_n(typical.descriptor, descriptor_size(), batch.descriptor.row(typical.row).data());
              batch.uncertainty[typical.row] = typical.uncertainty;
              batch.fitness[typical.row] = static_cast<float>(
                  fitness_ == SampleFitness::kNearest ? outcome_.fitness(executions, typical.execution)
                                                      : median_fitness(executions, typical.first));
              batch.valid[typical.row] = 1;
            });
}

double SampledEvaluator::median_fitness(const Executions& executions, int first) const {
  thread_local std::vector<double> values;
  values.resize(executor_.repeats());
  for (int s = 0; s < executor_.repeats(); ++s) values[s] = outcome_.fitness(executions, first + s);
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  if (values.size() % 2 == 1) return *middle;
  return (*std::max_element(values.begin(), middle) + *middle) / 2;
}

void SampledEvaluator::visit(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed,
                             const Visitor& visitor) const {
  visit_all(genomes, nullptr, begin, end, seed, visitor);
}

template <class Visit>
void SampledEvaluator::visit_all(const Rows& genomes, const std::int32_t* lengths, Eigen::Index begin,
                                 Eigen::Index end, Seed seed, Visit&& visit) const {
  for (Eigen::Index first = begin; first < end; first += block()) {
    const Eigen::Index last = std::min(end, first + block());
    switch (descriptor_size()) {
      case 1:
        visit_block<1>(genomes, lengths, first, last, seed, visit);
        break;
      case 2:
        visit_block<2>(genomes, lengths, first, last, seed, visit);
        break;
      case 3:
        visit_block<3>(genomes, lengths, first, last, seed, visit);
        break;
      case 4:
        visit_block<4>(genomes, lengths, first, last, seed, visit);
        break;
    }
  }
}

template <int D, class Visit>
void SampledEvaluator::visit_block(const Rows& genomes, const std::int32_t* lengths, Eigen::Index begin,
                                   Eigen::Index end, Seed seed, Visit&& visit) const {
  static_assert(D <= kMaxDimensions);
  thread_local Executions executions;
  thread_local Samples<D> samples;
  thread_local std::vector<std::uint8_t> possible;
  possible.resize(end - begin);
  executor_.execute(genomes, lengths, begin, end, seed, executions, possible.data());
  const int repeats = executor_.repeats();
  samples.resize(repeats);
  float* coordinates[D];
  for (int d = 0; d < D; ++d) coordinates[d] = samples.coordinate(d);
  for (Eigen::Index i = begin; i < end; ++i) {
    if (!possible[i - begin]) continue;
    const auto first = static_cast<int>(i - begin) * repeats;
    outcome_.describe(executions, first, repeats, coordinates);
    const Median<D> median = geometric_median<D>(samples);
    visit(executions, Typical{i, first, first + median.nearest, median.point.data(), median.mean_distance});
  }
}

void SampledEvaluator::visit_executions(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed,
                                        const EachVisitor& visitor) const {
  Executions executions;
  std::vector<std::uint8_t> possible(end - begin);
  for (Eigen::Index first = begin; first < end; first += block()) {
    const Eigen::Index last = std::min(end, first + block());
    executor_.execute(genomes, nullptr, first, last, seed, executions, possible.data());
    for (Eigen::Index i = first; i < last; ++i)
      if (possible[i - first]) visitor(executions, i, static_cast<int>(i - first) * executor_.repeats());
  }
}

void SampledEvaluator::mean_fitness(const Rows& genomes, Eigen::Index begin, Eigen::Index end, Seed seed,
                                    float* out) const {
  const int repeats = executor_.repeats();
  std::fill(out, out + (end - begin), std::numeric_limits<float>::quiet_NaN());
  visit_executions(genomes, begin, end, seed, [&](const Executions& executions, Eigen::Index row, int first) {
    double sum = 0;
    for (int s = 0; s < repeats; ++s) sum += outcome_.fitness(executions, first + s);
    out[row - begin] = static_cast<float>(sum / repeats);
  });
}

}  // namespace hbr::inline hierarchy
