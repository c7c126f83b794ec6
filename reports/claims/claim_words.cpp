#include "reports/claims/claim_words.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "pipeline/statistics/rank_sum.h"
#include "reports/text/format.h"

namespace hbr::inline reports {
namespace {

// In the unit of what was computed: ratios and chances have none.
std::string in_unit(const Check& check, const Measured& m, double x, int digits = 3) {
  if (check.kind == "ratio") return format_number(x, digits) + " times";
  if (check.kind == "a12") return format_number(x, digits);
  return format_quantity(x, m.of.unit, digits);
}

// The end of a range, as it is written in the file of claims.
std::string end_in_unit(const Check& check, const Measured& m, double x) {
  return in_unit(check, m, x, exact_digits(x));
}

std::string figures(const Check& check, const Measured& m) {
  if (check.kind == "value")
    return m.of.values.empty() ? format_quantity(m.of.median, m.of.unit)
                               : format_quartiles(m.of.median, m.of.q1, m.of.q3, m.of.unit);
  const std::string pair = fmt::format("{} against {}", format_quantity(m.of.median, m.of.unit),
                                       format_quantity(m.to.median, m.to.unit));
  const auto tested = shown_p(m);
  const std::string p = !tested || check.p_below >= 1
                            ? ""
                            : ", p = " + format_p(*tested) + (m.least_p ? ", the least for so few" : "");
  const std::string interval =
      m.interval ? fmt::format(" [{}; {}]", format_number(m.interval->low), format_number(m.interval->high))
                 : "";
  if (check.kind == "a12") return fmt::format("{} (A12 = {}{}{})", pair, format_number(*m.x), interval, p);
  return fmt::format("{}{} ({}{})", in_unit(check, m, *m.x), interval, pair, p);
}

// "n = 4", "n = 4 and 2"; "" of a single number.
std::string replications(const Measured& m) {
  if (m.of.values.empty()) return "";
  if (m.to.values.empty() || m.to.values.size() == m.of.values.size())
    return fmt::format("n = {}", m.of.values.size());
  return fmt::format("n = {} and {}", m.of.values.size(), m.to.values.size());
}

// "50 replications (this run: 3)": of each unit the need that is greatest.
std::string shortfalls(const std::vector<NeedFound>& needs) {
  std::map<std::string, const NeedFound*> greatest;
  std::vector<std::string> parts, missing;
  for (const NeedFound& n : needs) {
    if (n.met) continue;
    if (!n.found) {
      missing.push_back(n.need.of);
      continue;
    }
    const NeedFound*& kept = greatest[n.unit];
    if (!kept || n.need.at_least > kept->need.at_least ||
        (n.need.at_least == kept->need.at_least && *n.found < *kept->found))
      kept = &n;
  }
  for (const auto& [unit, n] : greatest)
    parts.push_back(
        fmt::format("{} {} (this run: {})", format_number(n->need.at_least), unit, format_number(*n->found)));
  if (!missing.empty()) parts.push_back(fmt::format("{} (not in this run)", fmt::join(missing, ", ")));
  return fmt::format("{}", fmt::join(parts, ", "));
}

// What a claim about size alone is about.
std::string least_replications(const std::vector<NeedFound>& needs) {
  std::optional<double> least;
  for (const NeedFound& n : needs)
    if (n.unit == "replications" && n.found) least = std::min(least.value_or(*n.found), *n.found);
  return least ? format_number(*least) + " replications" : "–";
}

// "2 of 3 checks hold, 1 in part, 1 was not measured."
std::string tally(const std::vector<Measured>& measured) {
  const auto count = [&](CheckOutcome outcome) {
    return std::ranges::count(measured, outcome, &Measured::outcome);
  };
  std::string text = fmt::format("{} of {} {}", count(CheckOutcome::yes), measured.size(),
                                 measured.size() == 1 ? "check holds" : "checks hold");
  if (const auto n = count(CheckOutcome::partly)) text += fmt::format(", {} in part", n);
  if (const auto n = count(CheckOutcome::undecided))
    text += fmt::format(", {} {} not told from chance", n, n == 1 ? "is" : "are");
  if (const auto n = count(CheckOutcome::absent)) text += fmt::format(", {} could not be measured", n);
  return text + ".";
}

}  // namespace

const char* outcome_name(CheckOutcome outcome) {
  switch (outcome) {
    case CheckOutcome::yes:
      return "yes";
    case CheckOutcome::partly:
      return "partly";
    case CheckOutcome::no:
      return "no";
    case CheckOutcome::undecided:
      return "undecided";
    case CheckOutcome::absent:
      break;
  }
  return "absent";
}

std::optional<double> shown_p(const Measured& m) {
  if (std::min(m.of.values.size(), m.to.values.size()) < kFewestToTest) return {};
  return m.p_together && !m.least_p ? m.p_together : m.p;
}

std::string check_ours(const Check& check, const Measured& m) {
  if (m.outcome == CheckOutcome::absent) return fmt::format("this run has no {}", m.absent);
  const std::string n = replications(m);
  const std::string more = m.would_tell ? fmt::format(" (about {} might tell)", *m.would_tell) : "";
  return figures(check, m) + (n.empty() ? "" : ", " + n + more);
}

std::string check_asked(const Check& check, const Measured& m) {
  const double low = check.reproduced[0], high = check.reproduced[1];
  std::string range;
  if (check.kind == "difference" && low == -high)
    range = "at most " + end_in_unit(check, m, high) + " either way";
  else if (low == high)
    range = end_in_unit(check, m, low);
  else if (std::isinf(high) || (check.kind == "a12" && high == 1))
    range = "at least " + end_in_unit(check, m, low);
  else if (low == 0)  // what claims are about is never negative
    range = "at most " + end_in_unit(check, m, high);
  else
    range = fmt::format("{} to {}", format_number(low, exact_digits(low)), end_in_unit(check, m, high));
  if (check.kind == "a12") range = "A12 " + range;
  return check.p_below < 1 ? range + fmt::format(" and p < {}", check.p_below) : range;
}

std::string check_figure(const Check& check, const Measured& m) {
  return (check.kind == "a12" ? "A12 " : "") + in_unit(check, m, *m.x);
}

std::string ours_in_words(const Claim& claim, const std::vector<Measured>& measured,
                          const std::vector<NeedFound>& needs) {
  if (claim.checks.empty()) return least_replications(needs);
  std::vector<std::string> parts;
  for (std::size_t i = 0; i < measured.size(); ++i)
    if (measured[i].outcome != CheckOutcome::absent)
      parts.push_back(measured.size() == 1
                          ? figures(claim.checks[i], measured[i])
                          : claim.checks[i].words + ": " + figures(claim.checks[i], measured[i]));
  return parts.empty() ? "–" : fmt::format("{}", fmt::join(parts, "; "));
}

std::string reason(const std::vector<Measured>& measured, const std::vector<NeedFound>& needs,
                   const std::string& indication) {
  std::vector<std::string> sentences;
  if (const std::string lacking = shortfalls(needs); !lacking.empty()) {
    sentences.push_back("Decided by a run of " + lacking + ".");
    if (!indication.empty()) sentences.push_back(fmt::format("At this size it would read: {}.", indication));
  }
  if (!measured.empty()) sentences.push_back(tally(measured));
  if (sentences.empty()) sentences.push_back("The run is as large as the paper's.");
  return fmt::format("{}", fmt::join(sentences, " "));
}

}  // namespace hbr::inline reports
