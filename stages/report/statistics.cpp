// Statistics: every artifact of the experiment -> statistics.json (pipeline/statistics/table.h). Inputs are
// named by their paths below OUT.
#include "pipeline/statistics/collect.h"

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/stage.h"

namespace hbr::inline stages {
namespace {

struct StatisticsSlice {
  std::string profile;
  std::vector<std::string> layers;
  nlohmann::json replications, generations;
};
template <class Fields>
void describe(Fields& f, StatisticsSlice& s) {
  f.text("profile", s.profile, "its name");
  f.texts("layers", s.layers, "the names of its layers");
  f.raw_table("replications", s.replications, "of the profile, told so that they count");
  f.raw_table("generations", s.generations, "of the searches, told so that they count");
}

void run(StageRun& stage) {
  const auto s = stage.settings_as<StatisticsSlice>();

  std::map<std::string, std::filesystem::path> artifacts;
  for (const std::string& name : stage.inputs()) artifacts[name] = stage.input(name);
  const nlohmann::json statistics =
      collect_statistics(s.profile, artifacts, {s.layers.begin(), s.layers.end()});
  write_file(stage.output(), statistics.dump(1) + "\n");
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "Statistics of all replications", hbr::run);
}
