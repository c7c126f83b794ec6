#include "reports/kept/kept_figures.h"

#include <fmt/format.h>

#include <cmath>
#include <regex>

#include "pipeline/core/check.h"
#include "reports/claims/verdicts.h"
#include "reports/text/format.h"
#include "reports/text/template.h"

namespace hbr::inline reports {
namespace {

std::string verdicts_in_words(const nlohmann::json& all) {
  const nlohmann::json claims = claims_decided_by("result", all);
  std::map<std::string, int> times;
  for (const nlohmann::json& claim : claims) ++times[claim.at("verdict")];
  return fmt::format("{} / {} / {} / {} of {}", times["reproduced"], times["partly"], times["undecided"],
                     times["not"], claims.size());
}

std::map<std::string, std::string> values_of(const KeptRun& run) {
  std::map<std::string, std::string> values{{"verdicts", verdicts_in_words(run.claims)}};
  if (run.costs.empty()) return values;
  const StageCost whole = whole_cost(run.costs);
  values["cpu"] = format_quantity(std::round(whole.cpu_seconds), "s");
  values["memory"] = format_number(whole.memory / 1e9, 2) + "\u202fGB";
  values["disk"] = format_number(whole.disk / 1e9, 2) + "\u202fGB";
  for (const auto& [stage, cost] : run.costs) {
    values["cpu." + stage] = format_quantity(cost.cpu_seconds, "s");
    values["each." + stage] = format_quantity(cost.cpu_seconds / cost.artifacts, "s");
  }
  return values;
}

}  // namespace

const nlohmann::json& statistics_of(const KeptRun& run, const std::string& variation) {
  const auto found = run.statistics.find(variation);
  if (found == run.statistics.end())
    throw InputError("the kept run '{}' has no variation '{}'", run.profile, variation);
  return found->second;
}

std::string with_figures(const std::string& text, const KeptRun& run, const std::string& variation) {
  static const std::regex place(R"(\{\{(\w+):([^:}]+)[^}]*\}\})"),  // {{KIND:NAME...}}
      cost("cpu|memory|disk|(cpu|each)\\..+");
  TemplateContent content;
  content.statistics = statistics_of(run, variation);
  const std::map<std::string, std::string> values = values_of(run);
  std::string needed;
  for (std::sregex_iterator at(text.begin(), text.end(), place), end; at != end; ++at) {
    if ((*at)[1] != "value") {
      needed += fmt::format(" {}:{}", (*at)[1].str(), (*at)[2].str());
    } else if (const auto found = values.find((*at)[2]); found != values.end()) {
      content.values.insert(*found);
    } else if (run.costs.empty() && std::regex_match((*at)[2].str(), cost)) {
      return kNotMeasured;  // kept before costs were
    }
  }
  return fill_template(
      needed.empty() ? text
                     : fmt::format("{{{{if{}}}}}{}{{{{else}}}}{}{{{{end}}}}", needed, text, kNotMeasured),
      content);
}

}  // namespace hbr::inline reports
