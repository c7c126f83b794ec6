#include "reports/compare/compared_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "pipeline/artifact/freshness.h"
#include "pipeline/artifact/json_file.h"
#include "pipeline/core/check.h"
#include "pipeline/core/file_error.h"
#include "pipeline/statistics/statistics_file.h"

namespace hbr::inline reports {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStatisticsFile = "statistics.json";

Node artifact_node(const std::string& output) {
  Node node;
  node.output = output;
  return node;
}

// "layer2/00.h5" of "OUT/layer2/00.json", "statistics.json" of "OUT/statistics.json.json"; "" where the file
// is beside no artifact.
std::string described(const fs::path& out, const fs::path& manifest) {
  const fs::path without = fs::path(manifest).replace_extension();
  for (const fs::path& artifact : {fs::path(without.string() + ".h5"), without})
    if (fs::exists(artifact)) return artifact.lexically_relative(out).string();
  return "";
}

// A folder that is an artifact has no manifests in it, and the report is a copy.
bool is_entered(const fs::path& folder, const fs::path& out) {
  return !folder.filename().string().starts_with('.') && !fs::exists(folder.string() + ".json") &&
         folder != out / "report";
}

void read_manifests(ComparedRun& run) {
  for (auto at = fs::recursive_directory_iterator(run.out); at != fs::end(at); ++at) {
    if (at->is_directory()) {
      if (!is_entered(at->path(), run.out)) at.disable_recursion_pending();
      continue;
    }
    if (at->path().extension() != ".json") continue;
    const std::string output = described(run.out, at->path());
    if (output.empty()) continue;
    try {
      run.manifests[output] = read_manifest(at->path());
    } catch (const InputError& problem) {
      run.missing.push_back(fmt::format("Nothing is known of {}: {}.", output, problem.what()));
    }
  }
}

// Whether the artifact is what its manifest says; else that is told.
bool is_whole(ComparedRun& run, const std::string& output) {
  const Found found = look_at({run.out, {}, {}}, artifact_node(output), Compare::by_fingerprint);
  if (found.state != State::fresh)
    run.missing.push_back(fmt::format("{} is not compared: {}.", output, found.why));
  return found.state == State::fresh;
}

bool are_claims(const nlohmann::json& claims) {
  return claims.is_array() && std::ranges::all_of(claims, [](const nlohmann::json& claim) {
           return claim.is_object() &&
                  std::ranges::all_of(
                      std::array{"id", "place", "statement", "ours", "verdict", "indication"},
                      [&](const char* key) { return claim.value(key, nlohmann::json()).is_string(); });
         });
}

}  // namespace

ComparedRun read_compared_run(const fs::path& out) {
  if (!fs::is_directory(out))
    throw InputError("{}: there is no such folder; expected that of a run", out.string());
  ComparedRun run;
  run.out = out;
  try {
    read_manifests(run);
  } catch (const fs::filesystem_error& error) {
    throw file_error(error);
  }
  if (run.manifests.empty())
    throw InputError(
        "{}: no run: no artifact in it has a manifest beside it; expected a folder that `make` left, "
        "such as out/reduced",
        out.string());
  for (const auto& [output, manifest] : run.manifests) {
    if (!output.ends_with(kStatisticsFile) || !is_whole(run, output)) continue;
    try {
      run.statistics[manifest.slice.variation] = read_statistics(out / output);
    } catch (const InputError& problem) {  // of another version, perhaps
      run.missing.push_back(fmt::format("{} is not compared: {}.", output, problem.what()));
    }
  }
  if (const auto own = run.statistics.find(""); own != run.statistics.end())
    run.profile = own->second.at("profile");
  else
    run.missing.push_back("There is no statistics.json: its quantities are not compared.");
  if (!run.manifests.contains("page"))
    run.missing.push_back("There is no page: its claims have no verdicts.");
  else if (is_whole(run, "page")) {
    nlohmann::json claims = read_json(out / "page/claims.json");
    if (are_claims(claims))
      run.claims = std::move(claims);
    else
      run.missing.push_back("The claims of its page are of another version, and not compared.");
  }
  return run;
}

}  // namespace hbr::inline reports
