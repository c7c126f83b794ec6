// The stored arcs executed again from fresh starts: what a stored fitness is worth. A search that sees one
// sample keeps lucky draws.
#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/parallel.h"
#include "pipeline/hierarchy/layers/arcs.h"
#include "stages/layers/read_stack.h"

namespace hbr {
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
    const StoredLayer arcs = read_layer(stage, input, below);
    const Executor executor(below.stack.points(), below.stack.top(), arcs.model->executor()->decoder(),
                            s.fresh_starts, {});
    const SampledEvaluator evaluator(executor, *arcs.model->sampled_outcome());
    std::vector<float> fresh(arcs.elites.size());
    workers.for_ranges(fresh.size(), 16, [&](std::size_t begin, std::size_t end) {
      evaluator.mean_fitness(arcs.elites.solution, static_cast<Eigen::Index>(begin),
                             static_cast<Eigen::Index>(end), seed.child(input), &fresh[begin]);
    });
    file.write(input + "/id", arcs.elites.id);
    file.write(input + "/stored", {fresh.size()}, arcs.elites.objective.data());
    file.write(input + "/fresh", fresh);
  }
  file.close();
}

}  // namespace
}  // namespace hbr

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "Stored arcs from fresh starts", hbr::run);
}
