// reference keep OUT FOLDER: what a finished run found, small enough for the repository, as FOLDER/PROFILE.
// reference verify OUT FOLDER: the run compared with it; exit code 2 where they differ.
// reference claims TOML FOLDER: the verdicts of what is kept in FOLDER by the rules as they are now.
// reference tables TOML FOLDER: the READMEs' tables and sentences filled from what is kept in FOLDER.
// No stage: it tells of runs, and makes no artifact.
#include <fmt/format.h>

#include <string_view>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/program.h"
#include "pipeline/core/check.h"
#include "reports/kept/kept_tables.h"
#include "reports/kept/verify.h"

namespace {

namespace fs = std::filesystem;

int keep(const hbr::KeptRun& run, const fs::path& folder) {
  hbr::write_kept(run, folder);
  fmt::print("{}: {} artifacts, {} quantities, {} claims kept\n", folder.string(), run.artifacts.size(),
             run.statistics.at("").at("quantities").size(), run.claims.size());
  return 0;
}

int verify(const hbr::KeptRun& run, const fs::path& folder) {
  const hbr::Verification found = hbr::verify(hbr::read_kept(folder), run);
  for (const std::string& line : found.differences) fmt::print("different: {}\n", line);
  for (const std::string& line : found.notes) fmt::print("note: {}\n", line);
  fmt::print("{}\n", found.summary);
  return found.differences.empty() ? 0 : 2;
}

int judge_anew(const fs::path& rules, const fs::path& references) {
  for (auto& [name, run] : hbr::read_all_kept(references)) {
    nlohmann::json claims = hbr::claims_anew(run, rules);
    if (claims == run.claims) continue;
    run.claims = std::move(claims);
    hbr::write_kept(run, references / name);
    fmt::print("{}: verdicts by other rules\n", (references / name).string());
  }
  return 0;
}

int fill_files(const fs::path& tables, const fs::path& references) {
  const auto kept = hbr::read_all_kept(references);
  for (const auto& [file, text] : hbr::filled_files(hbr::read_kept_tables(tables), kept, ".")) {
    const bool same = hbr::read_whole(file) == text;
    if (!same) hbr::write_whole(file, text);
    fmt::print("{}: {}\n", file, same ? "has the kept runs' figures" : "filled with the kept runs' figures");
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return hbr::guarded_main("reference", [&] {
    const std::string_view task = argc == 4 ? argv[1] : "";
    if (task == "claims") return judge_anew(argv[2], argv[3]);
    if (task == "tables") return fill_files(argv[2], argv[3]);
    if (task != "keep" && task != "verify")
      throw hbr::InputError(
          "expected a task and two paths: reference keep|verify OUT FOLDER, or reference claims|tables TOML "
          "FOLDER");
    const hbr::KeptRun run = hbr::read_run(argv[2]);
    if (run.profile.empty() || run.profile.starts_with('.') || run.profile.find('/') != std::string::npos)
      throw hbr::InputError("the profile's name '{}' can't name a folder below {}", run.profile, argv[3]);
    const fs::path folder = fs::path(argv[3]) / run.profile;
    return task == "keep" ? keep(run, folder) : verify(run, folder);
  });
}
