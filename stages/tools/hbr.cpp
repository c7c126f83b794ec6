// The tool behind the Makefile: cuts a profile into stages and runs those that are not as they should be.
#include <cstdio>
#include <string_view>

#include "pipeline/artifact/profile.h"
#include "pipeline/artifact/program.h"
#include "pipeline/artifact/tool.h"
#include "stages/plan/experiment.h"
#include "stages/plan/profile_keys.h"
#include "stages/plan/profile_name.h"

int main(int argc, char** argv) {
  if (argc == 3 && argv[1] == std::string_view("keys"))
    return hbr::guarded_main("hbr", [&] {
      const auto file = hbr::profile_file(argv[2], "stages/profiles");
      std::fputs(hbr::profile_keys(hbr::read_inheriting(file)).c_str(), stdout);
      return 0;
    });
  return hbr::tool_main(argc, argv, [](const std::filesystem::path& profile) {
    return hbr::experiment_graph(hbr::profile_file(profile, "stages/profiles"));
  });
}
