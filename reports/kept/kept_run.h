// What is kept of a run so that others can be compared with it: reports/reference/PROFILE.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "reports/kept/costs.h"

namespace hbr::inline reports {

struct KeptArtifact {
  std::string bytes;     // of its content's hash the first digits
  std::string settings;  // the same of what its stage was told
  bool operator==(const KeptArtifact&) const = default;
};

struct KeptRun {
  std::string profile;
  nlohmann::json toolchain;                          // as in toolchain.h; null where it was more than one
  std::set<std::string> versions;                    // of the repository
  std::map<std::string, nlohmann::json> statistics;  // the run's under "", and each variation's; no curves
  nlohmann::json claims;  // array of {id, paper, ours, verdict, indication, decided_by}
  std::map<std::string, KeptArtifact> artifacts;  // by their place below OUT; what statistics are made of
  std::map<std::string, StageCost> costs;         // none of runs that were kept before costs were
};

// What artifacts.csv says of the settings that an artifact's stage was told.
std::string settings_hash(const nlohmann::json& settings);

// The finished run in an output folder. Throws InputError where its report is missing, or something that it
// was made from has changed since.
KeptRun read_run(const std::filesystem::path& out);

// Its claims by the rules of a file (reports/claims.toml), which may have changed since it was kept; as they
// are kept.
nlohmann::json claims_anew(const KeptRun& run, const std::filesystem::path& rules);

// origin.json (profile, toolchain, versions), statistics.json and VARIATION.statistics.json, claims.json,
// artifacts.csv, costs.csv: texts of one line an entry, so that two can be compared by eye. What stood in the
// folder is replaced.
void write_kept(const KeptRun& run, const std::filesystem::path& folder);
// Throws InputError where a file is missing or not as write_kept left it.
KeptRun read_kept(const std::filesystem::path& folder);
// Those of all folders in it, by their names.
std::map<std::string, KeptRun> read_all_kept(const std::filesystem::path& references);

}  // namespace hbr::inline reports
