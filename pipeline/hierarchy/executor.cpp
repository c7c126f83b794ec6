#include "pipeline/hierarchy/executor.h"

#include "pipeline/core/check.h"
#include "pipeline/hierarchy/joints.h"

namespace hbr::inline hierarchy {

Executor::Executor(const PointLayer& points, const Layer& below, const Decoder& decoder, int repeats, Way way,
                   Starts starts)
    : points_(points), below_(below), decoder_(decoder), repeats_(repeats), way_(way), starts_(starts) {
  HBR_CHECK(repeats > 0, "{} executions", repeats);
  HBR_CHECK(repeats == 1 || !decoder.places(), "genomes that say where they begin do the same every time");
}

Executor Executor::fresh(int repeats) const {
  return Executor(points_, below_, decoder_, repeats, way_, {starts_.moved, false});
}

void Executor::start(Eigen::Index begin, int genomes, Seed seed, Executions& executions) const {
  thread_local std::vector<std::int32_t> starts;
  starts.resize(executions.size());
  if (starts_.common) {
    draw_starts(Seed(0).child("common starts"), starts.data());
    for (int i = 1; i < genomes; ++i) std::copy_n(starts.begin(), repeats_, starts.begin() + i * repeats_);
  } else {
    for (int i = 0; i < genomes; ++i) draw_starts(seed.child(begin + i), &starts[i * repeats_]);
  }
  executions.move(executions.all(), starts.data());
}

void Executor::draw_starts(Seed seed, std::int32_t* elites) const {
  Rng rng(seed);
  if (!starts_.moved) {
    const auto all = static_cast<std::uint32_t>(points_.size());
    for (int s = 0; s < repeats_; ++s) elites[s] = static_cast<std::int32_t>(rng.below(all));
    return;
  }
  const Robot& robot = *starts_.moved;
  std::vector<float> genome(robot.dof());
  std::vector<double> joints(repeats_ * robot.dof());
  for (int s = 0; s < repeats_; ++s) {
    for (float& gene : genome) gene = rng.uniform();
    decode_joints(robot, genome.data(), &joints[s * robot.dof()]);
  }
  std::vector<Pen> pens(repeats_);
  robot.pens(repeats_, joints.data(), pens.data());
  for (int s = 0; s < repeats_; ++s) elites[s] = points_.nearest(pens[s].position);
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

}  // namespace hbr::inline hierarchy
