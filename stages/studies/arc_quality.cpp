// The stored arcs executed again from fresh starts: what a stored fitness is worth, and what it is made of. A
// search that sees one sample keeps lucky draws.
#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/parallel.h"
#include "pipeline/hierarchy/layers/flat_arcs.h"
#include "stages/layers/read_stack.h"

namespace hbr::inline stages {
namespace {

struct ArcQualitySlice : RunTable {
  int fresh_starts = 0;
};
template <class Fields>
void describe(Fields& f, ArcQualitySlice& s) {
  describe_run(f, s);
  f.number("fresh_starts", s.fresh_starts, Range{1, 1e5},
           "starts from which every stored arc is executed again");
}

// Of every stored arc, each the mean over its executions.
struct Fresh {
  std::vector<float> fitness, irregularity, joint_term;
  explicit Fresh(Eigen::Index n) : fitness(n), irregularity(n), joint_term(n) {}
  void set(std::size_t i, double irregular, double joints) {
    irregularity[i] = static_cast<float>(irregular);
    joint_term[i] = static_cast<float>(joints);
    fitness[i] = static_cast<float>(-(irregular + joints));
  }
};

void execute(const StoredLayer& arcs, std::size_t begin, std::size_t end, int starts, Seed seed,
             Fresh& fresh) {
  const ArcOutcome& outcome = arc_outcome(*arcs.model);
  const Executor executor = arcs.model->executor()->fresh(starts);
  const SampledEvaluator evaluator(executor, outcome);
  evaluator.visit_executions(arcs.elites.solution, static_cast<Eigen::Index>(begin),
                             static_cast<Eigen::Index>(end), seed,
                             [&](const Executions& executions, Eigen::Index row, int first) {
                               double irregular = 0, joints = 0;
                               for (int s = first; s < first + starts; ++s) {
                                 irregular += outcome.irregularity_of(executions, s) / starts;
                                 joints += outcome.joint_cost(executions, s) / starts;
                               }
                               fresh.set(static_cast<std::size_t>(row), irregular, joints);
                             });
}

// A flat arc does the same every time, unless it begins anywhere.
void execute_flat(const StoredLayer& arcs, std::size_t begin, std::size_t end, int starts, Seed seed,
                  Fresh& fresh) {
  const FlatArcEvaluator& evaluator = flat_arc_evaluator(*arcs.model);
  const int executions = evaluator.deterministic() ? 1 : starts;
  std::vector<float> irregular(end - begin), joint(end - begin);
  std::vector<double> irregular_sum(end - begin), joint_sum(end - begin);
  for (int s = 0; s < executions; ++s) {
    evaluator.terms(arcs.elites.solution, static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end),
                    seed.child(static_cast<std::uint64_t>(s)), irregular.data(), joint.data());
    for (std::size_t i = 0; i < irregular.size(); ++i) {
      irregular_sum[i] += irregular[i];
      joint_sum[i] += joint[i];
    }
  }
  for (std::size_t i = 0; i < irregular.size(); ++i)
    fresh.set(begin + i, irregular_sum[i] / executions, joint_sum[i] / executions);
}

// All inputs but the layers below are repertoires of arcs.
void run(StageRun& stage) {
  const auto s = stage.settings_as<ArcQualitySlice>();
  StackOnBody below = read_stack(stage, "below");
  const Seed seed = seed_of(stage, s);
  Workers workers(stage.threads());
  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  for (const std::string& input : stage.inputs()) {
    if (input.starts_with("below")) continue;
    StackOnBody none;
    const bool flat = input == "flat_arcs";
    const StoredLayer arcs = read_layer(stage, input, flat ? none : below);
    Fresh fresh(arcs.elites.size());
    workers.for_ranges(fresh.fitness.size(), 16, [&](std::size_t begin, std::size_t end) {
      (flat ? execute_flat : execute)(arcs, begin, end, s.fresh_starts, seed.child(input), fresh);
    });
    file.write(input + "/id", arcs.elites.id);
    file.write(input + "/stored", {fresh.fitness.size()}, arcs.elites.objective.data());
    file.write(input + "/fresh", fresh.fitness);
    file.write(input + "/irregularity", fresh.irregularity);
    file.write(input + "/joint_term", fresh.joint_term);
  }
  file.close();
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "Stored arcs from fresh starts", hbr::run);
}
