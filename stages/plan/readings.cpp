#include "stages/plan/readings.h"

#include <algorithm>
#include <set>

#include "pipeline/artifact/profile.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/factorial_design.h"

namespace hbr::inline stages {
namespace {

constexpr const char* kLedger = "reports/readings.toml";
constexpr std::size_t kMostValues = 10;  // a digit each

// Of the readings that the ledger holds; the report reads all of it.
std::vector<std::string> ids_in_ledger() {
  const SettingsSource ledger = read_toml(kLedger);
  const auto readings = ledger.values.find("readings");
  if (readings == ledger.values.end() || !readings->is_array())
    throw InputError("{}: expected the list of tables 'readings'", kLedger);
  std::vector<std::string> ids;
  for (const nlohmann::json& reading : *readings) {
    if (!reading.is_object() || !reading.contains("id") || !reading["id"].is_string())
      throw InputError("{}: readings.{}: expected a table with the text 'id'", kLedger, ids.size());
    ids.push_back(reading["id"].get<std::string>());
  }
  return ids;
}

void check(const std::string& file, const ReadingsTable& readings) {
  const std::vector<std::string> ledger = ids_in_ledger();
  std::set<std::string> taken;
  for (const StudiedOption& option : readings.options) {
    const std::string where = file + ": readings.options '" + option.id + "'";
    if (std::ranges::find(ledger, option.id) == ledger.end())
      throw InputError("{}: there is no such reading in {}{}", where, kLedger,
                       did_you_mean(option.id, ledger));
    if (!taken.insert(option.id).second)
      throw InputError("{}: stands twice; expected each reading once", where);
    if (option.values.size() < 2 || option.values.size() > kMostValues)
      throw InputError("{}: {} values; expected 2 to {}", where, option.values.size(), kMostValues);
    std::set<std::string> names;
    for (const OptionValue& value : option.values)
      if (value.name.empty() || !names.insert(value.name).second)
        throw InputError("{}: the value '{}' has no name, or that of another; expected different names",
                         where, value.name);
    if (!option.values[0].set.empty())
      throw InputError("{}: the first value sets keys; expected none: it is what the profile says itself",
                       where);
  }
}

}  // namespace

std::vector<Combination> combinations_of(const std::string& file, const ReadingsTable& readings) {
  if (readings.options.empty()) return {};
  check(file, readings);
  std::vector<int> levels;
  for (const StudiedOption& option : readings.options)
    levels.push_back(static_cast<int>(option.values.size()));
  std::vector<Combination> combinations;
  for (const Levels& run : factorial_design(levels, readings.combinations)) {
    std::string name = "readings_";
    for (const int level : run) name += static_cast<char>('0' + level);
    combinations.push_back({name, run});
  }
  return combinations;
}

Node readings_stage(const ReadingsTable& readings, const std::vector<Combination>& combinations) {
  const std::string claims = "reports/claims.toml", figures = "reports/paper_figures.toml";
  nlohmann::json settings = {{"claims", claims}, {"figures", figures}};
  for (const StudiedOption& option : readings.options) {
    settings["readings"].push_back({{"id", option.id}, {"values", nlohmann::json::array()}});
    for (const OptionValue& value : option.values)
      settings["readings"].back()["values"].push_back(value.name);
  }
  std::vector<std::pair<std::string, std::string>> inputs;
  for (const Combination& combination : combinations) {
    const bool plain = std::ranges::all_of(combination.levels, [](int level) { return level == 0; });
    const std::string name = plain ? "" : combination.name,
                      statistics = plain ? "statistics.json" : name + "/statistics.json";
    settings["runs"].push_back({{"name", name}, {"levels", combination.levels}});
    inputs.emplace_back(statistics, statistics);
  }
  return {"readings", "readings", -1, "readings.json", settings, inputs, {claims, figures}};
}

}  // namespace hbr::inline stages
