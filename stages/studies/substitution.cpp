// Layer 1 exchanged under a finished hierarchy (paper, section 5.2): the same arcs executed over the original
// and over the substitute, and what becomes of their regularity and of the joints.
#include <array>

#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/check.h"
#include "pipeline/core/parallel.h"
#include "pipeline/hierarchy/layers/arcs.h"
#include "stages/layers/read_stack.h"

namespace hbr::inline stages {
namespace {

struct SubstitutionSlice : RunTable {};
template <class Fields>
void describe(Fields& f, SubstitutionSlice& s) {
  describe_run(f, s);
}

// M1, M2, M3 of an execution, larger is better.
std::array<float, 3> metrics(const ArcOutcome& arcs, const Executions& executions, int execution) {
  const JointCost& few = named(joint_costs(), "few_joints", "cost");
  return {static_cast<float>(-arcs.irregularity_of(executions, execution)),
          static_cast<float>(-arcs.joint_cost(executions, execution)),
          static_cast<float>(-ArcOutcome::mean_joint_cost(executions, execution, few))};
}

void run(StageRun& stage) {
  const auto s = stage.settings_as<SubstitutionSlice>();
  const Seed seed = seed_of(stage, s);
  Workers workers(stage.threads());
  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  std::vector<std::int64_t> id;
  for (const char* name : {"original", "substitute"}) {
    const StackOnBody stack = read_stack(stage, name);
    const LayerModel& arcs = stack.top();
    const Elites& elites = stack.elites.back();
    HBR_CHECK(id.empty() || id == elites.id, "other arcs over the substitute");
    id = elites.id;
    const ArcOutcome& outcome = arc_outcome(arcs);
    const SampledEvaluator evaluator(*arcs.executor(), outcome);
    std::vector<float> rows(elites.size() * 3);
    workers.for_ranges(elites.size(), 16, [&](std::size_t begin, std::size_t end) {
      evaluator.visit(elites.solution, static_cast<Eigen::Index>(begin), static_cast<Eigen::Index>(end),
                      seed.child(name),
                      [&](const Executions& executions, const SampledEvaluator::Typical& typical) {
                        const auto m = metrics(outcome, executions, typical.execution);
                        std::copy(m.begin(), m.end(), &rows[3 * typical.row]);
                      });
    });
    file.write(name, {static_cast<std::size_t>(elites.size()), 3}, rows.data());
  }
  file.write("id", id);
  file.close();
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Substitution of layer 1", hbr::run); }
