#include "stages/plan/experiment.h"

#include <algorithm>
#include <set>

#include "pipeline/artifact/profile.h"
#include "pipeline/artifact/variations.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/names.h"
#include "stages/plan/old_keys.h"
#include "stages/plan/plan.h"
#include "stages/plan/readings.h"

namespace hbr::inline stages {
namespace {

// The profile with some of its own tables of changes laid over it, to be read as strictly as itself.
SettingsSource varied(const SettingsSource& source, const std::vector<std::string>& pointers,
                      const std::string& name) {
  SettingsSource profile = source;
  for (const std::string& pointer : pointers) {
    const SettingsSource changes = part_of(source, pointer);
    for (const char* key : {"name", "variations", "readings"})
      if (changes.values.contains(key)) {
        const SettingsSource::Position at = changes.keys.at(std::string("/") + key);
        throw InputError("{}:{}:{}: variation '{}' can't change '{}'; expected a key that a stage depends on",
                         at.file, at.line, at.column, name, key);
      }
    refuse_old_keys(changes);
    profile = laid_over(profile, changes);
  }
  profile.values["name"] = profile.values["name"].get<std::string>() + "/" + name;
  profile.values["variations"] = nlohmann::json::array();
  profile.values["readings"] = {{"combinations", 0}, {"options", nlohmann::json::array()}};
  return profile;
}

// A variation's name is a make goal and a folder beside those of the stages.
void check_variations(const std::string& file, const Profile& profile, const Graph& graph,
                      const std::vector<Combination>& combinations) {
  std::set<std::string> taken = goals_of_make();
  taken.insert({"experiment", "page", "report", "readings"});
  for (const Combination& combination : combinations) taken.insert(combination.name);
  for (const Node& node : graph) taken.insert({node.stage, node.stage.substr(0, node.stage.find('_'))});
  for (const ProfileVariation& v : profile.variations) {
    check_name(file, "variations", v.name);
    if (!taken.insert(v.name).second)
      throw InputError("{}: variations: name '{}' stands twice, or is a stage's or make's own", file, v.name);
    if (v.changes.empty())
      throw InputError("{}: variation '{}' has no `changes`; expected a sentence for the report", file,
                       v.name);
  }
}

// What draws robots in three dimensions: read where it is, and where it is not the page shows their pictures.
const std::string kThree = ".cache/three";
std::vector<std::string> three_files() {
  std::vector<std::string> files;
  for (const char* name : {"LICENSE", "OrbitControls.js", "three.module.min.js"})
    files.push_back(kThree + "/" + name);
  return files;
}

// The page: everything of the experiment by its own name, and the statistics of every variation.
Node report_of(const Profile& profile, const std::vector<LayerRow>& layers, const Graph& graph) {
  const std::string claims = "reports/claims.toml", readings = "reports/readings.toml",
                    speed = "reports/reference/bench.json";
  const auto none = nlohmann::json::array();
  nlohmann::json settings = {{"claims", claims}, {"readings", readings}, {"speed", speed}, {"layers", none},
                             {"robots", none},   {"variations", none},   {"three", ""}};
  for (const LayerRow& row : layers)
    settings["layers"].push_back({{"name", row.name},
                                  {"kind", row.kind->name},
                                  {"meaning", row.kind->meaning},
                                  {"below", row.below},
                                  {"answers", row.kind->answers},
                                  {"asks", row.kind->asks}});
  for (const RobotSettings& robot : profile.robots) settings["robots"].push_back(robot.name);
  for (const ProfileVariation& v : profile.variations)
    settings["variations"].push_back({{"name", v.name}, {"changes", v.changes}});
  std::vector<std::pair<std::string, std::string>> inputs;
  for (const Node& node : graph)
    if (node.variation.empty() || node.stage == "statistics") inputs.emplace_back(node.output, node.output);
  Node report{"report", "report", -1, "page", settings, inputs, {claims, readings, speed}};
  if (std::ranges::none_of(graph, [](const Node& node) { return node.program == "robot_shape"; }))
    return report;
  const std::vector<std::string> three = three_files();
  if (std::ranges::all_of(three, [](const std::string& file) { return std::filesystem::exists(file); })) {
    report.settings["three"] = kThree;
    report.sources.insert(report.sources.end(), three.begin(), three.end());
  } else {
    report.wished = three;
  }
  return report;
}

// The page shows a variation's statistics alone.
Graph planned(const SettingsSource& source, const std::string& where, bool is_variation) {
  Plan plan(source, where);
  plan_learned(plan);
  plan_layers(plan);
  plan_studies(plan);
  plan_robots(plan);
  plan_statistics(plan);
  if (!is_variation) {
    plan_explorer(plan);
    plan_shown_robots(plan);
  }
  return std::move(plan.graph());
}

}  // namespace

Graph experiment_graph(const std::filesystem::path& file) {
  const SettingsSource source = read_inheriting(file);
  refuse_old_keys(source);
  const auto profile = settings_from_source<Profile>(source);
  Graph graph = planned(source, file.string(), false);
  const std::vector<Combination> combinations = combinations_of(file.string(), profile.readings);
  check_variations(file.string(), profile, graph, combinations);
  const auto add = [&](Graph& to, const std::string& name, const std::vector<std::string>& changes) {
    const std::string where = fmt::format("{}: variation '{}'", file.string(), name);
    add_variation(to, name, planned(varied(source, changes, name), where, true));
  };
  const auto refuse_unchanged = [&](const std::string& what, std::size_t before, std::size_t after) {
    if (after - before < 2)  // the statistics are always its own
      throw InputError("{}: {} changes nothing that this profile runs; expected keys that a stage depends on",
                       file.string(), what);
  };
  const Graph plain = graph;
  for (std::size_t i = 0; i < profile.variations.size(); ++i) {
    const std::size_t before = graph.size();
    add(graph, profile.variations[i].name, {fmt::format("/variations/{}/set", i)});
    refuse_unchanged("variation '" + profile.variations[i].name + "'", before, graph.size());
  }
  const auto set_of = [](std::size_t option, int value) {
    return fmt::format("/readings/options/{}/values/{}/set", option, value);
  };
  for (const Combination& combination : combinations) {
    std::vector<std::string> changes;
    for (std::size_t i = 0; i < combination.levels.size(); ++i)
      if (combination.levels[i] > 0) changes.push_back(set_of(i, combination.levels[i]));
    if (!changes.empty()) add(graph, combination.name, changes);
  }
  for (std::size_t i = 0; i < profile.readings.options.size(); ++i) {
    const StudiedOption& option = profile.readings.options[i];
    for (std::size_t v = 1; v < option.values.size(); ++v) {
      Graph alone = plain;
      add(alone, "alone", {set_of(i, static_cast<int>(v))});
      refuse_unchanged(fmt::format("readings.options '{}': the value '{}'", option.id, option.values[v].name),
                       plain.size(), alone.size());
    }
  }
  if (!combinations.empty()) graph.push_back(readings_stage(profile.readings, combinations));
  graph.push_back(report_of(profile, layer_rows(source), graph));
  return graph;
}

}  // namespace hbr::inline stages
