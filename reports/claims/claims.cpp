#include "reports/claims/claims.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "pipeline/core/check.h"
#include "pipeline/statistics/rank_sum.h"
#include "reports/claims/claim_file.h"
#include "reports/claims/claim_words.h"
#include "reports/claims/measured.h"

namespace hbr {
namespace {

using nlohmann::json;

bool within(double x, const std::vector<double>& range) { return x >= range[0] && x <= range[1]; }

// So few replications can't give a smaller p than the test's floor for them.
bool significant(const Check& check, const Measured& m) {
  if (check.p_below >= 1) return true;
  if (!m.p) return false;
  const double floor = least_p(m.of.values.size(), m.to.values.size());
  return *m.p < check.p_below || (floor >= check.p_below && *m.p <= floor * (1 + 1e-12));
}

Measured measure(const Check& check, const StatisticsReader& statistics) {
  Measured m;
  const auto of = statistics.figure(check.of), to = statistics.figure(check.to);
  if (!of) m.absent = check.of;
  if (!check.to.empty() && !to) m.absent = check.to;
  if (!m.absent.empty()) return m;
  m.of = *of;
  if (to) m.to = *to;
  m.x = computed(check.kind, m.of, m.to);
  if (!m.of.values.empty() && !m.to.values.empty()) {
    const RankSum test = rank_sum(m.of.values, m.to.values);
    m.p = test.p;
    m.a12 = test.a12;
  }
  if (!m.x) {
    m.absent = check.kind + " of " + check.of;
  } else if (within(*m.x, check.reproduced)) {
    m.outcome = significant(check, m) ? CheckOutcome::yes : CheckOutcome::partly;
  } else {
    m.outcome = within(*m.x, check.partly) ? CheckOutcome::partly : CheckOutcome::no;
  }
  return m;
}

// Of the checks that could be made.
std::string verdict_of(const std::vector<Measured>& measured) {
  int made = 0, yes = 0, no = 0;
  for (const Measured& m : measured) {
    made += m.outcome != CheckOutcome::absent;
    yes += m.outcome == CheckOutcome::yes;
    no += m.outcome == CheckOutcome::no;
  }
  if (made == 0) return "";
  return yes == made ? "reproduced" : no == made ? "not" : "partly";
}

std::vector<NeedFound> needs_of(const Claim& claim, const ClaimFile& file,
                                const StatisticsReader& statistics) {
  std::vector<NeedFound> found;
  const auto size = std::ranges::find(file.sizes, claim.size, &Size::name);
  if (size == file.sizes.end()) return found;
  for (const Need& need : size->needs) {
    NeedFound n{need, {}, "replications", false};
    if (const auto figure = statistics.figure(need.of)) {
      const bool quantity = !figure->values.empty();
      n.found = quantity ? static_cast<double>(figure->values.size()) : figure->median;
      if (!quantity) n.unit = figure->unit;
      n.met = *n.found >= need.at_least;
    }
    found.push_back(n);
  }
  return found;
}

json range_json(const std::vector<double>& range) {
  json result = json::array();
  for (const double end : range) result.push_back(std::isfinite(end) ? json(end) : json());
  return result;
}

json check_json(const Check& check, const Measured& m) {
  json result = {{"words", check.words},
                 {"kind", check.kind},
                 {"of", check.of},
                 {"to", check.to},
                 {"reproduced", range_json(check.reproduced)},
                 {"partly", range_json(check.partly)},
                 {"p_below", check.p_below},
                 {"outcome", outcome_name(m.outcome)},
                 {"asked", check_asked(check, m)},
                 {"ours", check_ours(check, m)}};
  if (m.x) {
    result["x"] = *m.x;
    result["figure"] = check_figure(check, m);
  }
  if (const auto p = shown_p(m)) result["p"] = *p;
  if (m.a12) result["a12"] = *m.a12;
  return result;
}

json evaluated(const Claim& claim, const ClaimFile& file, const StatisticsReader& statistics) {
  std::vector<Measured> measured;
  json checks = json::array(), needs = json::array();
  std::set<std::string> sources;
  for (const Check& check : claim.checks) {
    measured.push_back(measure(check, statistics));
    checks.push_back(check_json(check, measured.back()));
    for (const std::string& name : {check.of, check.to})
      if (!name.empty()) sources.insert(name);
  }
  const std::vector<NeedFound> found = needs_of(claim, file, statistics);
  for (const NeedFound& n : found) {
    needs.push_back({{"of", n.need.of}, {"at_least", n.need.at_least}, {"met", n.met}});
    needs.back()["found"] = n.found ? json(*n.found) : json();
    if (claim.checks.empty()) sources.insert(n.need.of);
  }
  const bool large_enough = std::ranges::all_of(found, &NeedFound::met);
  const bool complete =
      std::ranges::none_of(measured, [](const Measured& m) { return m.outcome == CheckOutcome::absent; });
  const std::string indication = verdict_of(measured);
  const std::string decided = claim.checks.empty() ? "reproduced" : indication;
  return {{"id", claim.id},
          {"place", claim.place},
          {"statement", claim.statement},
          {"quote", claim.quote},
          {"paper", claim.paper},
          {"decided_by", claim.decided_by},
          {"ours", ours_in_words(claim, measured, found)},
          {"verdict", large_enough && complete ? decided : "not at this size"},
          {"indication", indication},
          {"reason", reason(measured, found, indication)},
          {"sources", sources},
          {"checks", checks},
          {"needs", needs}};
}

}  // namespace

json evaluate_claims(const std::filesystem::path& claims, const json& statistics) {
  const ClaimFile file = read_claim_file(claims);
  const StatisticsReader reader(statistics);
  json result = json::array();
  for (const Claim& claim : file.claims) result.push_back(evaluated(claim, file, reader));
  return result;
}

}  // namespace hbr
