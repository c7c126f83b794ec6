// The tool behind the Makefile: cuts a profile into stages and runs those that are not as they should be.
#include "pipeline/artifact/tool.h"
#include "stages/plan/experiment.h"
#include "stages/plan/profile_name.h"

int main(int argc, char** argv) {
  return hbr::tool_main(argc, argv, [](const std::filesystem::path& profile) {
    return hbr::experiment_graph(hbr::profile_file(profile, "stages/profiles"));
  });
}
