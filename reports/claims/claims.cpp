#include "reports/claims/claims.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "pipeline/core/check.h"
#include "pipeline/statistics/rank_sum.h"
#include "pipeline/statistics/summary.h"
#include "reports/claims/claim_file.h"
#include "reports/claims/claim_words.h"
#include "reports/claims/measured.h"

namespace hbr::inline reports {
namespace {

using nlohmann::json;

// The level at which a test tells a difference from chance at all; some of the paper's own p-values are far
// smaller.
constexpr double kLevel = 0.05;

bool within(double x, const std::vector<double>& range) { return x >= range[0] && x <= range[1]; }

bool tested(const Check& check, const Measured& m) { return check.p_below < 1 && m.p; }

// So few replications can't give a smaller p, and it would not be small enough were it the least of all
// tests.
bool least_possible(const Check& check, const Measured& m, std::size_t tests) {
  const double floor = least_p(m.of.values.size(), m.to.values.size());
  return floor * static_cast<double>(tests) >= check.p_below && *m.p <= floor * (1 + 1e-12);
}

// By the test, read together with all others; so few replications that they can't give a p that would do are
// read alone, where they give the least that they can.
bool told(const Check& check, const Measured& m, double level) {
  if (!tested(check, m)) return check.p_below >= 1;
  return *m.p_together < level || (m.least_p && *m.p < std::max(level, kLevel));
}

// Of x, where there are replications enough to draw from.
std::optional<Interval> interval_of(const Check& check, const Measured& m) {
  const std::size_t of = m.of.values.size(), to = check.to.empty() ? of : m.to.values.size();
  if (check.kind == "value" || std::min(of, to) < kFewestToTest) return {};
  const Interval interval = bootstrap(
      m.of.values, m.to.values,
      [&](std::span<const double> a, std::span<const double> b) {
        const auto middle = [](std::span<const double> values) {
          std::vector<double> sorted(values.begin(), values.end());
          std::ranges::sort(sorted);
          return quantile(sorted, 0.5);
        };
        if (check.kind == "a12") return effect_size(a, b);
        const double x = middle(a), y = middle(b);
        return check.kind == "difference" ? x - y : x / y;
      },
      check.kind + " " + check.of + " " + check.to);
  if (!std::isfinite(interval.low) || !std::isfinite(interval.high)) return {};
  return interval;
}

// All but the outcome.
Measured measure(const Check& check, const StatisticsReader& statistics) {
  Measured m;
  const auto of = statistics.figure(check.of), to = statistics.figure(check.to);
  if (!of) m.absent = check.of;
  if (!check.to.empty() && !to) m.absent = check.to;
  if (!m.absent.empty()) return m;
  m.of = *of;
  if (to) m.to = *to;
  m.x = computed(check.kind, m.of, m.to);
  if (!m.x) {
    m.absent = check.kind + " of " + check.of;
    return m;
  }
  if (!m.of.values.empty() && !m.to.values.empty()) {
    const RankSum test = rank_sum(m.of.values, m.to.values);
    m.p = test.p;
    m.a12 = test.a12;
    m.interval = interval_of(check, m);
  }
  return m;
}

CheckOutcome outcome_of(const Check& check, const Measured& m) {
  if (!m.x) return CheckOutcome::absent;
  if (!within(*m.x, check.partly)) return CheckOutcome::no;
  if (within(*m.x, check.reproduced) && told(check, m, check.p_below)) return CheckOutcome::yes;
  return told(check, m, std::max(check.p_below, kLevel)) ? CheckOutcome::partly : CheckOutcome::undecided;
}

// What every check of every claim came to. The tests that decide are read together.
std::vector<std::vector<Measured>> measured_claims(const std::vector<Claim>& claims,
                                                   const StatisticsReader& statistics) {
  std::vector<std::vector<Measured>> all;
  std::vector<double> p;
  for (const Claim& claim : claims) {
    all.emplace_back();
    for (const Check& check : claim.checks) {
      all.back().push_back(measure(check, statistics));
      if (tested(check, all.back().back())) p.push_back(*all.back().back().p);
    }
  }
  const std::vector<double> together = adjusted_together(p);
  auto next = together.begin();
  for (std::size_t c = 0; c < claims.size(); ++c)
    for (std::size_t k = 0; k < claims[c].checks.size(); ++k) {
      Measured& m = all[c][k];
      const Check& check = claims[c].checks[k];
      if (tested(check, m)) {
        m.p_together = *next++;
        m.least_p = least_possible(check, m, p.size());
      }
      m.outcome = outcome_of(check, m);
      if (!m.p_together) continue;
      const bool lacks_evidence = within(*m.x, check.reproduced) ? m.outcome != CheckOutcome::yes
                                                                 : m.outcome == CheckOutcome::undecided;
      if (lacks_evidence)
        m.would_tell = replications_to_tell(*m.a12, check.p_below / static_cast<double>(p.size()));
    }
  return all;
}

// Two samples that do not differ hold it, too.
bool met_by_no_effect(const Check& check) {
  if (check.kind == "value" || check.p_below < 1) return false;
  return within(check.kind == "ratio" ? 1 : check.kind == "difference" ? 0 : 0.5, check.partly);
}

// Of the checks that could be made. Where the claim asks for an effect as well, what is met without any is a
// condition: it can keep the claim from holding, and is no evidence for it.
std::string verdict_of(const Claim& claim, const std::vector<Measured>& measured) {
  const bool asks_for_effect = !std::ranges::all_of(claim.checks, met_by_no_effect);
  std::map<CheckOutcome, std::size_t> count;
  std::size_t evidence = 0;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const CheckOutcome outcome = measured[k].outcome;
    ++count[outcome];
    const bool holds = outcome == CheckOutcome::yes || outcome == CheckOutcome::partly;
    if (holds && !(asks_for_effect && met_by_no_effect(claim.checks[k]))) ++evidence;
  }
  const std::size_t made = measured.size() - count[CheckOutcome::absent];
  if (made == 0) return "";
  if (count[CheckOutcome::yes] == made) return "reproduced";
  if (evidence > 0) return "partly";
  return count[CheckOutcome::no] > 0 ? "not" : "undecided";
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
  if (m.p && m.p_together && shown_p(m)) result["p_alone"] = *m.p;
  if (m.a12) result["a12"] = *m.a12;
  if (m.would_tell) result["would_tell"] = *m.would_tell;
  if (m.interval) result["interval"] = {m.interval->low, m.interval->high};
  return result;
}

json evaluated(const Claim& claim, const std::vector<Measured>& measured, const ClaimFile& file,
               const StatisticsReader& statistics) {
  json checks = json::array(), needs = json::array();
  std::set<std::string> sources;
  for (std::size_t k = 0; k < measured.size(); ++k) {
    const Check& check = claim.checks[k];
    checks.push_back(check_json(check, measured[k]));
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
  const std::string indication = verdict_of(claim, measured);
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
  const std::vector<std::vector<Measured>> measured = measured_claims(file.claims, reader);
  json result = json::array();
  for (std::size_t c = 0; c < file.claims.size(); ++c)
    result.push_back(evaluated(file.claims[c], measured[c], file, reader));
  return result;
}

}  // namespace hbr::inline reports
