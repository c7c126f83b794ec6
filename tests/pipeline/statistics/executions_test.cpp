// How often the genomes of a search were executed.
#include <gmock/gmock.h>

#include "pipeline/core/check.h"
#include "pipeline/statistics/collect.h"
#include "tests/support/synthetic_experiment.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

// A genome is executed once for each of its samples, or once where its descriptor holds the start; genomes
// that start nowhere in particular have no executions.
TEST(Collect, ExecutionsOfWhatIsSampled) {
  TemporaryFolder folder;
  SyntheticExperiment experiment(folder.path(), 1);
  experiment.search("layer2_n10", 40, 2, -0.1, -0.5, 100, 10);
  experiment.search("reference4d", 40, 4, -0.1, -0.5, 50);
  experiment.search("layer1", 40, 8, -0.1, -0.5, 100);
  const nlohmann::json found = collect_statistics("tiny", experiment.artifacts())["numbers"];
  EXPECT_EQ(found["layer2.n10.executions"]["value"], 200000);
  EXPECT_EQ(found["reference4d.executions"]["value"], 10000);
  EXPECT_FALSE(found.contains("layer1.executions"));
}

// A file of another version, or a damaged one, is not one with a sample.
TEST(Collect, ExecutionsOfSettingsThatSayNothingAreRefused) {
  TemporaryFolder folder;
  SyntheticExperiment experiment(folder.path(), 1);
  experiment.search("layer2_n10", 40, 2, -0.1, -0.5, 100, 10);
  const auto& [name, path] = *experiment.artifacts().begin();
  for (const auto& [settings, told] :
       {std::pair(R"({"layer": {"starts": "elites", "samples": "ten"}})",
                  "layer: samples: expected a number"),
        {R"({"layer": {"starts": "elites", "samples": null}})", "layer: samples: expected a number"},
        {R"({"layer": {"starts": "elites", "samples": 0}})", "layer: samples: expected a number from 1"},
        {R"({"layer": ["starts"]})", "layer: expected a table"},
        {R"(["layer"])", "settings: expected a table"},
        {R"({"layer": )", "settings: not JSON"}}) {
    const Elites elites = read_elites(path);
    const std::vector<ProgressRow> progress = read_progress(path);
    Hdf5Writer file(path);
    write_elites(file, elites, progress);
    file.attribute("settings", std::string(settings));
    file.close();
    EXPECT_THAT([&] { collect_statistics("tiny", experiment.artifacts()); },
                testing::ThrowsMessage<InputError>(testing::AllOf(
                    testing::StartsWith(path.string() + ": settings"), testing::HasSubstr(told))));
  }
}

}  // namespace
}  // namespace hbr
