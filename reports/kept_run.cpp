#include "reports/kept_run.h"

#include <fmt/format.h>

#include <fstream>
#include <sstream>
#include <vector>

#include "pipeline/artifact/freshness.h"
#include "pipeline/core/check.h"
#include "reports/figure.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kStatistics = "statistics.json";
constexpr std::size_t kDigits = 16;  // of a hash: enough to tell a thousand artifacts apart

json read_json(const fs::path& path) {
  std::ifstream file(path);
  json contents = json::parse(file, nullptr, false);
  if (contents.is_discarded()) throw InputError("{} is missing or no JSON", path.string());
  return contents;
}

std::string short_hash(const std::string& hash) { return hash.substr(0, kDigits); }

Node node_at(const std::string& output) {
  Node node;
  node.output = output;
  return node;
}

Manifest manifest_of(const fs::path& out, const std::string& output) {
  auto manifest = read_manifest(manifest_path(out, node_at(output)));
  if (!manifest || artifact_hash({out, {}, {}}, node_at(output)) != manifest->content.sha256)
    throw InputError("{} is missing or damaged; `make all` of the profile makes it", (out / output).string());
  return *manifest;
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

KeptRun read_run(const fs::path& out) {
  if (!fs::exists(out / "page.json"))
    throw InputError("{} holds no finished run: its report is missing; `make all` of the profile makes it",
                     out.string());
  KeptRun run;
  bool first = true;
  std::vector<std::string> waiting{"page"};
  std::map<std::string, std::string> seen;  // output -> sha256
  while (!waiting.empty()) {
    const std::string output = waiting.back();
    waiting.pop_back();
    const Manifest manifest = manifest_of(out, output);
    seen[output] = manifest.content.sha256;
    note_toolchain(run, manifest, first);
    if (output.ends_with(kStatistics)) {
      const std::string variation = manifest.made_from.slice.value("variation", "");
      run.statistics[variation] = without_curves(read_json(out / output));
    } else if (output != "page") {
      run.artifacts[output] = {short_hash(manifest.content.sha256),
                               short_hash(sha256_of_text(manifest.made_from.slice.at("settings").dump()))};
    }
    for (const auto& [name, input] : manifest.made_from.slice.at("inputs").items())
      if (!seen.contains(input)) {
        seen[input] = "";
        waiting.push_back(input);
      }
  }
  // Everything that anything was made from is what stands there now.
  for (const auto& [output, hash] : seen) {
    const Manifest manifest = *read_manifest(manifest_path(out, node_at(output)));
    for (const auto& [name, input] : manifest.made_from.slice.at("inputs").items())
      if (manifest.made_from.inputs.at(name) != seen.at(input))
        throw InputError("{} was made from another {} than is there now; `make all` of the profile mends it",
                         (out / output).string(), input.get<std::string>());
  }
  for (const json& claim : read_json(out / "page/claims.json")) {
    json kept;
    for (const char* key : {"id", "paper", "ours", "verdict", "indication"}) kept[key] = claim.at(key);
    run.claims.push_back(kept);
  }
  run.profile = run.statistics.at("").at("profile");
  return run;
}

void write_kept(const KeptRun& run, const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw InputError("cannot make {}: {}", folder.string(), error.message());
  for (const auto& entry : fs::directory_iterator(folder))  // of variations that are no more
    if (entry.path().filename().string().ends_with(kStatistics)) fs::remove(entry.path(), error);
  write_file(
      folder / "origin.json",
      json{{"profile", run.profile}, {"toolchain", run.toolchain}, {"versions", run.versions}}.dump(1) +
          "\n");
  for (const auto& [variation, statistics] : run.statistics)
    write_file(folder / ((variation.empty() ? "" : variation + ".") + kStatistics), in_lines(statistics));
  write_file(folder / "claims.json", list_in_lines(run.claims));
  std::string artifacts = "artifact,sha256,settings\n";
  for (const auto& [name, artifact] : run.artifacts)
    artifacts += fmt::format("{},{},{}\n", name, artifact.bytes, artifact.settings);
  write_file(folder / "artifacts.csv", artifacts);
}

KeptRun read_kept(const fs::path& folder) {
  if (!fs::exists(folder / "origin.json"))
    throw InputError("{}: there is no reference; `make reference` keeps one of a finished run",
                     folder.string());
  KeptRun run;
  try {
    const json origin = read_json(folder / "origin.json");
    run.profile = origin.at("profile");
    run.toolchain = origin.at("toolchain");
    origin.at("versions").get_to(run.versions);
    run.claims = read_json(folder / "claims.json");
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (!name.ends_with(kStatistics)) continue;
      const std::string head = name.substr(0, name.size() - std::string(kStatistics).size());
      run.statistics[head.substr(0, head.size() - !head.empty())] = read_json(entry.path());
    }
    for (const auto& [variation, statistics] : run.statistics)
      statistics.at("quantities"), statistics.at("numbers");
    run.statistics.at("");
  } catch (const std::exception& problem) {
    throw InputError("{}: not a reference as `make reference` leaves it: {}", folder.string(),
                     problem.what());
  }
  std::ifstream file(folder / "artifacts.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string name, bytes, settings;
    if (!std::getline(fields, name, ',') || !std::getline(fields, bytes, ',') ||
        !std::getline(fields, settings, ','))
      throw InputError("{}: '{}' is no line of it; expected artifact,sha256,settings",
                       (folder / "artifacts.csv").string(), line);
    run.artifacts[name] = {bytes, settings};
  }
  return run;
}

}  // namespace hbr
