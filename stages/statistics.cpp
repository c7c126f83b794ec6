// Statistics: every artifact of the experiment -> statistics.json (pipeline/statistics/table.h). Inputs are
// named by their paths below OUT.
#include "pipeline/statistics/collect.h"

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace {

void run(StageRun& stage) {
  const auto profile = stage.settings().find("profile");
  if (profile == stage.settings().end() || !profile->is_string())
    throw InputError("{}: the settings have no text 'profile'; expected the profile's name", stage.name());

  std::map<std::string, std::filesystem::path> artifacts;
  for (const std::string& name : stage.inputs()) artifacts[name] = stage.input(name);
  const nlohmann::json statistics = collect_statistics(*profile, artifacts);
  write_file(stage.output(), statistics.dump(1) + "\n");
}

}  // namespace
}  // namespace hbr

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "Statistics of all replications", hbr::run);
}
