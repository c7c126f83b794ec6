// A layer beside its flat baseline where both had as many generations.
#include <gtest/gtest.h>

#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/statistics/collect.h"
#include "tests/support/synthetic_experiment.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using nlohmann::json;

// The flat baseline runs three times longer: what it had at the end of layer 3 is in its course.
TEST(Collect, EqualGenerationsOfLayerAndBaseline) {
  TemporaryFolder folder;
  SyntheticExperiment experiment(folder.path(), 1);
  experiment.search("layer3_n1", 40, 10, -0.1, -0.5, 100);
  experiment.search("flat_arcs", 40, 40, -0.2, -0.9, 300);
  const json found = collect_statistics("tiny", experiment.artifacts())["quantities"];
  const auto flat = read_progress(folder.path() / "flat_arcs/00.h5");
  const auto layer = read_progress(folder.path() / "layer3_n1/00.h5");
  const ProgressRow& row = flat[6];  // 90 of 300; the next is 105
  ASSERT_EQ(row.generation, 90);
  EXPECT_EQ(found["flat_arcs.equal_size"]["median"], static_cast<double>(row.size));
  EXPECT_EQ(found["flat_arcs.equal_best"]["median"], row.best);
  EXPECT_EQ(found["flat_arcs.equal_mean"]["median"], row.mean);
  EXPECT_EQ(found["layer3.n1.equal_mean"]["median"], layer.back().mean);
  std::int64_t covered = -1;
  for (const ProgressRow& r : flat)
    if (covered < 0 && static_cast<double>(r.size) >= 0.9 * static_cast<double>(row.size))
      covered = r.generation;
  EXPECT_EQ(found["flat_arcs.covering_generations"]["median"], static_cast<double>(covered));

  // A variant of the layer that is stopped early decides for itself alone.
  experiment.search("layer3_quick", 20, 10, -0.1, -0.5, 20);
  const json beside = collect_statistics("tiny", experiment.artifacts())["quantities"];
  for (const char* name : {"flat_arcs.equal_mean", "layer3.n1.equal_mean", "flat_arcs.covering_generations"})
    EXPECT_EQ(beside[name], found[name]) << name;
  EXPECT_EQ(beside["layer3.quick.equal_mean"]["median"],
            read_progress(folder.path() / "layer3_quick/00.h5").back().mean);
}

}  // namespace
}  // namespace hbr
