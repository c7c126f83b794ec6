// reference keep OUT FOLDER: what a finished run found, small enough for the repository, as FOLDER/PROFILE.
// reference verify OUT FOLDER: the run compared with it; exit code 2 where they differ. No stage: it tells of
// runs, and makes no artifact.
#include <fmt/format.h>

#include <string_view>

#include "pipeline/artifact/program.h"
#include "pipeline/core/check.h"
#include "reports/kept/verify.h"

int main(int argc, char** argv) {
  return hbr::guarded_main("reference", [&] {
    const std::string_view task = argc == 4 ? argv[1] : "";
    if (task != "keep" && task != "verify")
      throw hbr::InputError("expected a task and two folders: reference keep|verify OUT FOLDER");
    const hbr::KeptRun run = hbr::read_run(argv[2]);
    if (run.profile.empty() || run.profile.starts_with('.') || run.profile.find('/') != std::string::npos)
      throw hbr::InputError("the profile's name '{}' can't name a folder below {}", run.profile, argv[3]);
    const std::filesystem::path folder = std::filesystem::path(argv[3]) / run.profile;
    if (task == "keep") {
      hbr::write_kept(run, folder);
      fmt::print("{}: {} artifacts, {} quantities, {} claims kept\n", folder.string(), run.artifacts.size(),
                 run.statistics.at("").at("quantities").size(), run.claims.size());
      return 0;
    }
    const hbr::Verification found = hbr::verify(hbr::read_kept(folder), run);
    for (const std::string& line : found.differences) fmt::print("different: {}\n", line);
    for (const std::string& line : found.notes) fmt::print("note: {}\n", line);
    fmt::print("{}\n", found.summary);
    return found.differences.empty() ? 0 : 2;
  });
}
