#include "pipeline/hierarchy/executor.h"

#include "pipeline/core/check.h"

namespace hbr {

Executor::Executor(const PointLayer& points, const Layer& below, const Decoder& decoder, int repeats, Way way)
    : points_(points), below_(below), decoder_(decoder), repeats_(repeats), way_(way) {
  HBR_CHECK(repeats > 0, "{} executions", repeats);
  HBR_CHECK(repeats == 1 || !decoder.places(), "genomes that say where they begin do the same every time");
}

void Executor::start(Eigen::Index begin, int genomes, Seed seed, Executions& executions) const {
  thread_local std::vector<std::int32_t> starts;
  const auto elites = static_cast<std::uint32_t>(points_.size());
  starts.resize(executions.size());
  for (int i = 0; i < genomes; ++i) {
    Rng rng(seed.child(begin + i));
    for (int s = 0; s < repeats_; ++s)
      starts[i * repeats_ + s] = static_cast<std::int32_t>(rng.below(elites));
  }
  executions.move(executions.all(), starts.data());
}

void Executor::execute(const Rows& genomes, const std::int32_t* lengths, Eigen::Index begin, Eigen::Index end,
                       Seed seed, Executions& executions, std::uint8_t* possible) const {
  thread_local Plans plans;
  thread_local std::vector<std::int32_t> which, group;
  const auto n = static_cast<int>(end - begin);
  plans.make(decoder_, points_, below_, genomes, lengths, begin, n);
  executions.begin(points_, n * repeats_, way_);
  if (!decoder_.places()) start(begin, n, seed, executions);
  which.clear();
  for (int i = 0; i < n; ++i) {
    possible[i] = plans.possible(i);
    if (possible[i]) which.push_back(i);
  }
  Group all = executions.all();
  if (static_cast<int>(which.size()) < n) {
    group.clear();
    for (const std::int32_t i : which)
      for (int s = 0; s < repeats_; ++s) group.push_back(i * repeats_ + s);
    all = group;
  }
  plans.perform(executions, all, which.data(), repeats_);
}

}  // namespace hbr
