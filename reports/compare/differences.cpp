#include "reports/compare/differences.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/core/check.h"

namespace hbr::inline reports {
namespace {

using nlohmann::json;

// Calls both(output, manifest of A, manifest of B) for what both runs have.
template <class Both>
void for_both(const ComparedRun& a, const ComparedRun& b, Both both) {
  for (const auto& [output, of_a] : a.manifests)
    if (const auto of_b = b.manifests.find(output); of_b != b.manifests.end()) both(of_a, of_b->second);
}

std::string stage_of(const Manifest& manifest) {
  const Slice& slice = manifest.slice;
  return slice.variation.empty() ? slice.stage : slice.variation + "/" + slice.stage;
}

// "search.generations" -> 100, for every value that is no table.
void flatten(const std::string& key, const json& value, std::map<std::string, std::string>& flat) {
  if (!value.is_object()) {
    flat[key] = value.dump();
    return;
  }
  for (const auto& [name, inner] : value.items()) flatten(key.empty() ? name : key + "." + name, inner, flat);
}

std::string value_of(const std::map<std::string, std::string>& flat, const std::string& key) {
  const auto found = flat.find(key);
  return found == flat.end() ? "" : found->second;
}

// "settings, inputs": what the artifact was made from otherwise.
std::string why_other(const Ingredients& a, const Ingredients& b) {
  std::vector<const char*> reasons;
  if (a.slice.at("settings") != b.slice.at("settings")) reasons.push_back("settings");
  if (a.program != b.program) reasons.push_back("program");
  if (a.inputs != b.inputs) reasons.push_back("inputs");
  if (a.sources != b.sources) reasons.push_back("sources");
  return fmt::format("{}", fmt::join(reasons, ", "));
}

const json* claim_with(const json& claims, const std::string& id) {
  const auto found = std::ranges::find_if(claims, [&](const json& c) { return c.at("id") == id; });
  return found == claims.end() ? nullptr : &*found;
}

// Quantities and numbers alike.
std::map<std::string, MeasureRow> measures_of(const json& statistics, std::vector<double> MeasureRow::*side) {
  std::map<std::string, MeasureRow> rows;
  if (statistics.is_null()) return rows;
  for (const char* table : {"quantities", "numbers"})
    for (const auto& [name, entry] : statistics.at(table).items()) {
      MeasureRow& row = rows[name];
      row.name = name;
      row.unit = entry.at("unit");
      row.meaning = entry.at("meaning");
      if (entry.contains("values"))
        row.*side = entry.at("values").get<std::vector<double>>();
      else
        row.*side = {entry.at("value").get<double>()};
    }
  return rows;
}

// Greater is shown first.
double effect(const MeasureRow& row) {
  if (row.a.empty() || row.b.empty() || row.same()) return -1;
  return row.test ? std::abs(row.test->a12 - 0.5) : 0;
}

}  // namespace

std::vector<SettingDifference> setting_differences(const ComparedRun& a, const ComparedRun& b) {
  std::map<std::array<std::string, 3>, std::set<std::string>> found;
  for_both(a, b, [&](const Manifest& of_a, const Manifest& of_b) {
    std::map<std::string, std::string> flat_a, flat_b;
    flatten("", of_a.slice.settings, flat_a);
    flatten("", of_b.slice.settings, flat_b);
    std::set<std::string> keys;
    for (const auto* flat : {&flat_a, &flat_b})
      for (const auto& [key, value] : *flat) keys.insert(key);
    for (const std::string& key : keys)
      if (const std::string in_a = value_of(flat_a, key), in_b = value_of(flat_b, key); in_a != in_b)
        found[{key, in_a, in_b}].insert(stage_of(of_a));
  });
  std::vector<SettingDifference> rows;
  for (const auto& [difference, stages] : found)
    rows.push_back({difference[0], difference[1], difference[2], stages});
  return rows;
}

std::vector<OriginRow> origins(const ComparedRun& a, const ComparedRun& b) {
  std::vector<OriginRow> rows;
  for (const char* word :
       {"version", "compiler", "flags", "architecture", "processor", "libraries", "host"}) {
    OriginRow row{word, {}, {}};
    for (const auto& [run, words] : {std::pair(&a, &row.a), std::pair(&b, &row.b)})
      for (const auto& [output, manifest] : run->manifests)
        if (manifest.run.contains(word)) words->insert(manifest.run.at(word).get<std::string>());
    rows.push_back(row);
  }
  return rows;
}

std::vector<StageRow> stage_rows(const ComparedRun& a, const ComparedRun& b) {
  std::map<std::string, StageRow> rows;
  for (const auto& [output, manifest] : a.manifests)
    if (!b.manifests.contains(output)) ++rows[stage_of(manifest)].only_a;
  for (const auto& [output, manifest] : b.manifests)
    if (!a.manifests.contains(output)) ++rows[stage_of(manifest)].only_b;
  for_both(a, b, [&](const Manifest& of_a, const Manifest& of_b) {
    StageRow& row = rows[stage_of(of_a)];
    if (of_a.content.sha256 == of_b.content.sha256)
      ++row.same;
    else
      ++row.others[why_other(of_a.made_from, of_b.made_from)];
  });
  std::vector<StageRow> all;
  for (auto& [stage, row] : rows) {
    row.stage = stage;
    all.push_back(row);
  }
  return all;
}

bool ClaimRow::moved() const {
  if (a.is_null() || b.is_null()) return false;
  return a.at("verdict") != b.at("verdict") || a.at("indication") != b.at("indication");
}

std::vector<ClaimRow> claim_rows(const ComparedRun& a, const ComparedRun& b) {
  std::vector<ClaimRow> rows;
  for (const json& claim : a.claims) {
    const json* other = claim_with(b.claims, claim.at("id"));
    rows.push_back({claim, other ? *other : json()});
  }
  for (const json& claim : b.claims)
    if (!claim_with(a.claims, claim.at("id"))) rows.push_back({json(), claim});
  return rows;
}

std::vector<MeasureRow> measure_rows(const json& a, const json& b) {
  std::map<std::string, MeasureRow> rows = measures_of(a, &MeasureRow::a);
  for (auto& [name, of_b] : measures_of(b, &MeasureRow::b)) {
    const auto [row, only_b] = rows.emplace(name, of_b);
    if (only_b) continue;
    row->second.b = of_b.b;
    if (std::min(row->second.a.size(), of_b.b.size()) >= kFewestToTest && !row->second.same())
      row->second.test = rank_sum(of_b.b, row->second.a);
  }
  std::vector<MeasureRow> all;
  for (auto& [name, row] : rows) all.push_back(std::move(row));
  std::ranges::stable_sort(all, std::ranges::greater(), effect);
  return all;
}

}  // namespace hbr::inline reports
