#include "reports/kept/kept_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "pipeline/artifact/freshness.h"
#include "pipeline/artifact/json_file.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/statistics_file.h"
#include "reports/claims/claims.h"
#include "reports/kept/lineage.h"

namespace hbr::inline reports {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kStatistics = "statistics.json";
constexpr std::size_t kDigits = 16;  // of a hash: enough to tell a thousand artifacts apart

constexpr const char* kHead = "artifact,sha256,settings";
constexpr const char* kCostsHead = "stage,artifacts,seconds,cpu_seconds,memory,disk";

bool is_short_hash(const std::string& text) {
  return text.size() == kDigits && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

std::map<std::string, KeptArtifact> read_artifacts(const fs::path& file) {
  std::istringstream lines(read_whole(file));
  std::string line;
  if (!std::getline(lines, line) || line != kHead)
    throw InputError("{}: expected '{}' as its first line, found '{}'", file.string(), kHead, line);
  std::map<std::string, KeptArtifact> artifacts;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string name;
    KeptArtifact artifact;
    std::getline(fields, name, ',');
    std::getline(fields, artifact.bytes, ',');
    std::getline(fields, artifact.settings);
    if (name.empty() || !is_short_hash(artifact.bytes) || !is_short_hash(artifact.settings) ||
        !artifacts.emplace(name, artifact).second)
      throw InputError("{}: expected lines of {}, each artifact once and {} digits of each hash, found '{}'",
                       file.string(), kHead, kDigits, line);
  }
  return artifacts;
}

std::map<std::string, StageCost> read_costs(const fs::path& file) {
  if (!fs::exists(file)) return {};
  std::istringstream lines(read_whole(file));
  std::string line;
  if (!std::getline(lines, line) || line != kCostsHead)
    throw InputError("{}: expected '{}' as its first line, found '{}'", file.string(), kCostsHead, line);
  std::map<std::string, StageCost> costs;
  while (std::getline(lines, line)) {
    std::istringstream fields(line);
    std::string stage;
    StageCost cost;
    char c1 = 0, c2 = 0, c3 = 0, c4 = 0;
    std::getline(fields, stage, ',');
    fields >> cost.artifacts >> c1 >> cost.seconds >> c2 >> cost.cpu_seconds >> c3 >> cost.memory >> c4 >>
        cost.disk;
    const bool whole = fields && fields.peek() == EOF && std::string{c1, c2, c3, c4} == ",,,,";
    if (stage.empty() || !whole ||
        !(std::min({double(cost.artifacts), cost.seconds, cost.cpu_seconds, cost.memory, cost.disk}) >= 0) ||
        !costs.emplace(stage, cost).second)
      throw InputError("{}: expected lines of {}, each stage once and no number below 0, found '{}'",
                       file.string(), kCostsHead, line);
  }
  return costs;
}

std::string short_hash(const std::string& hash) { return hash.substr(0, kDigits); }

Node node_at(const std::string& output) {
  Node node;
  node.output = output;
  return node;
}

// Of claims.json what is kept.
struct KeptClaim {
  std::string id, paper, ours, verdict, indication, decided_by;
};
template <class Fields>
void describe(Fields& f, KeptClaim& c) {
  f.text("id", c.id, "unique");
  f.text("paper", c.paper, "the paper's figures");
  f.text("ours", c.ours, "this run's figures");
  f.text("verdict", c.verdict, "what became of it");
  f.text("indication", c.indication, "what it would be without regard to size");
  f.choice("decided_by", c.decided_by, {"result", "design", "ours"}, "what decides it");
}
struct KeptClaims {
  std::vector<KeptClaim> claims;
};
template <class Fields>
void describe(Fields& f, KeptClaims& c) {
  f.tables("claims", c.claims, "the paper's claims");
}

struct Origin {
  std::string profile;
  std::map<std::string, std::string> toolchain;
  std::vector<std::string> versions;
};
template <class Fields>
void describe(Fields& f, Origin& o) {
  f.text("profile", o.profile, "its name");
  f.named_texts("toolchain", o.toolchain, "as in toolchain.h, or null where it was more than one");
  f.texts("versions", o.versions, "of the repository");
}

void check_claims(const json& claims, const fs::path& file) {
  settings_from_json<KeptClaims>(json{{"claims", claims}}, file.string());
}

// Of each claim what is kept; missing keys are left for the check.
json kept_of(const json& claims) {
  json kept = json::array();
  for (const json& claim : claims) {
    kept.push_back(json::object());
    for (const char* key : {"id", "paper", "ours", "verdict", "indication", "decided_by"})
      if (claim.is_object() && claim.contains(key)) kept.back()[key] = claim[key];
  }
  return kept;
}

// Throws InputError where the artifact is not what its manifest says.
void check_artifact(const fs::path& out, const std::string& output) {
  const Found found = look_at({out, {}, {}}, node_at(output), Compare::by_fingerprint);
  if (found.state != State::fresh)
    throw InputError("{}: {}; `make all` of the profile makes it again", (out / output).string(), found.why);
}

json without_curves(json statistics) {
  statistics.erase("curves");
  return statistics;
}

void note_toolchain(KeptRun& run, const Manifest& manifest, bool& first) {
  json own;
  for (const char* key : {"compiler", "flags", "architecture", "processor", "libraries"})
    if (manifest.run.contains(key)) own[key] = manifest.run[key];
  if (first)
    run.toolchain = own;
  else if (run.toolchain != own)
    run.toolchain = nullptr;
  first = false;
  run.versions.insert(manifest.run.value("version", "unknown"));
}

// A table of tables, the inner ones a line each.
std::string in_lines(const json& tables) {
  std::string text = "{";
  for (const auto& [name, table] : tables.items()) {
    text += fmt::format("{}\n{}: ", text.size() > 1 ? "," : "", json(name).dump());
    if (!table.is_object()) {
      text += table.dump();
      continue;
    }
    std::string lines;
    for (const auto& [key, value] : table.items())
      lines += fmt::format("{}\n {}: {}", lines.empty() ? "" : ",", json(key).dump(), value.dump());
    text += "{" + lines + "\n}";
  }
  return text + "\n}\n";
}

std::string list_in_lines(const json& list) {
  std::string text;
  for (const json& each : list) text += (text.empty() ? "[\n " : ",\n ") + each.dump();
  return text.empty() ? "[]\n" : text + "\n]\n";
}

}  // namespace

std::string settings_hash(const json& settings) { return short_hash(sha256_of_text(settings.dump())); }

KeptRun read_run(const fs::path& out) {
  if (!fs::exists(out / "page.json"))
    throw InputError("{} holds no finished run: its report is missing; `make all` of the profile makes it",
                     out.string());
  KeptRun run;
  bool first = true;
  const std::map<std::string, Manifest> manifests = lineage(out, "page");
  for (const auto& [output, manifest] : manifests) {
    check_artifact(out, output);
    note_toolchain(run, manifest, first);
    if (output.ends_with(kStatistics))
      run.statistics[manifest.slice.variation] = without_curves(read_statistics(out / output));
    else if (output != "page")
      run.artifacts[output] = {short_hash(manifest.content.sha256), settings_hash(manifest.slice.settings)};
    // Everything that it was made from is what stands there now.
    for (const auto& [name, input] : manifest.slice.inputs)
      if (manifest.made_from.inputs.at(name) != manifests.at(input).content.sha256)
        throw InputError("{} was made from another {} than is there now; `make all` of the profile mends it",
                         (out / output).string(), input);
  }
  if (!run.statistics.contains(""))
    throw InputError(
        "{}: its report was made from no statistics.json; `make all` of the profile makes it again",
        out.string());
  run.claims = kept_of(read_json(out / "page/claims.json"));
  check_claims(run.claims, out / "page/claims.json");
  run.profile = run.statistics.at("").at("profile");
  run.costs = stage_costs(manifests);
  return run;
}

json claims_anew(const KeptRun& run, const fs::path& rules) {
  return kept_of(evaluate_claims(rules, run.statistics.at("")));
}

void write_kept(const KeptRun& run, const fs::path& folder) {
  fs::create_directories(folder);
  write_whole(
      folder / "origin.json",
      json{{"profile", run.profile}, {"toolchain", run.toolchain}, {"versions", run.versions}}.dump(1) +
          "\n");
  for (const auto& [variation, statistics] : run.statistics)
    write_whole(folder / ((variation.empty() ? "" : variation + ".") + kStatistics), in_lines(statistics));
  write_whole(folder / "claims.json", list_in_lines(run.claims));
  std::string artifacts = std::string(kHead) + "\n";
  for (const auto& [name, artifact] : run.artifacts)
    artifacts += fmt::format("{},{},{}\n", name, artifact.bytes, artifact.settings);
  write_whole(folder / "artifacts.csv", artifacts);
  std::string costs = std::string(kCostsHead) + "\n";
  for (const auto& [stage, cost] : run.costs)
    costs += fmt::format("{},{},{},{},{},{}\n", stage, cost.artifacts, cost.seconds, cost.cpu_seconds,
                         cost.memory, cost.disk);
  write_whole(folder / "costs.csv", costs);
  for (const auto& entry : fs::directory_iterator(folder)) {  // of variations that are no more
    const std::string file = entry.path().filename().string();
    if (!file.ends_with(kStatistics)) continue;
    const std::string variation = file.substr(0, file.size() - std::string(kStatistics).size());
    if (!run.statistics.contains(variation.substr(0, variation.size() - (variation.empty() ? 0 : 1))))
      fs::remove(entry.path());
  }
}

KeptRun read_kept(const fs::path& folder) {
  if (!fs::exists(folder / "origin.json"))
    throw InputError("{}: there is no reference; `make reference` keeps one of a finished run",
                     folder.string());
  KeptRun run;
  json origin = read_json(folder / "origin.json");
  if (origin.is_object() && origin.contains("toolchain")) run.toolchain = origin["toolchain"];
  if (run.toolchain.is_null() && origin.is_object()) origin["toolchain"] = json::object();
  const auto known = settings_from_json<Origin>(origin, (folder / "origin.json").string());
  run.profile = known.profile;
  run.versions = {known.versions.begin(), known.versions.end()};
  run.claims = read_json(folder / "claims.json");
  for (json& claim : run.claims)  // kept before facts of the design were told apart
    if (claim.is_object() && !claim.contains("decided_by")) claim["decided_by"] = "result";
  check_claims(run.claims, folder / "claims.json");
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (!name.ends_with(kStatistics)) continue;
    const std::string head = name.substr(0, name.size() - std::string(kStatistics).size());
    run.statistics[head.substr(0, head.size() - !head.empty())] = read_statistics(entry.path());
  }
  if (!run.statistics.contains(""))
    throw InputError("{}: missing; `make reference` keeps it of a finished run",
                     (folder / kStatistics).string());
  run.artifacts = read_artifacts(folder / "artifacts.csv");
  run.costs = read_costs(folder / "costs.csv");
  return run;
}

std::map<std::string, KeptRun> read_all_kept(const fs::path& references) {
  std::map<std::string, KeptRun> all;
  for (const auto& entry : fs::directory_iterator(references))
    if (entry.is_directory()) all[entry.path().filename().string()] = read_kept(entry.path());
  return all;
}

}  // namespace hbr::inline reports
