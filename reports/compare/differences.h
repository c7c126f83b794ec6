// In what two runs differ, as tables; A and B are the two.
#pragma once

#include <optional>
#include <set>

#include "pipeline/statistics/rank_sum.h"
#include "reports/compare/compared_run.h"

namespace hbr::inline reports {

// A key of the settings that some stages of both runs were told otherwise.
struct SettingDifference {
  std::string key;               // "search.generations"
  std::string a, b;              // as JSON; "" where the stage was not told it
  std::set<std::string> stages;  // which were
};
std::vector<SettingDifference> setting_differences(const ComparedRun& a, const ComparedRun& b);

// A word of the manifests' records, and what it is in each run.
struct OriginRow {
  std::string word;  // "version", "compiler", ...
  std::set<std::string> a, b;
};
std::vector<OriginRow> origins(const ComparedRun& a, const ComparedRun& b);

// The artifacts of a stage, those of a variation of the profile apart.
struct StageRow {
  std::string stage;                             // "rho_012/layer2_n10"
  std::size_t only_a = 0, only_b = 0, same = 0;  // artifacts; the bytes are the same
  std::map<std::string, std::size_t> others;     // other bytes, by why: "settings, inputs"
  bool only_in_one() const { return same == 0 && others.empty() && (only_a == 0 || only_b == 0); }
  bool differs() const { return only_a + only_b > 0 || !others.empty(); }
};
std::vector<StageRow> stage_rows(const ComparedRun& a, const ComparedRun& b);

struct ClaimRow {
  nlohmann::json a, b;  // as in claims.json; null where one run has no such claim
  const nlohmann::json& either() const { return a.is_null() ? b : a; }
  bool moved() const;  // another verdict, or another indication where neither is decided
};
// In the claims' order.
std::vector<ClaimRow> claim_rows(const ComparedRun& a, const ComparedRun& b);

// A quantity or a number of the statistics of both runs, or of one.
struct MeasureRow {
  std::string name, unit, meaning;
  std::vector<double> a, b;     // one value per replication
  std::optional<RankSum> test;  // B against A, of kFewestToTest values and more that are not the same
  bool same() const { return a == b; }
};
// What both have and is not the same first, the greatest effect leading; by names otherwise.
std::vector<MeasureRow> measure_rows(const nlohmann::json& a, const nlohmann::json& b);

}  // namespace hbr::inline reports
