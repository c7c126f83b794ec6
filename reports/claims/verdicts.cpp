#include "reports/claims/verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "pipeline/core/check.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

// A sign beside the colour, for those who see no colours.
struct Verdict {
  const char *name, *sign, *css;
};
constexpr std::array<Verdict, 5> kVerdicts = {{{"reproduced", "✓", "reproduced"},
                                               {"partly", "◐", "partly"},
                                               {"undecided", "?", "undecided"},
                                               {"not", "✗", "not"},
                                               {"not at this size", "○", "not-at-this-size"}}};

const Verdict& verdict_named(const std::string& name, const std::string& whose) {
  const auto found = std::ranges::find(kVerdicts, name, [](const Verdict& v) { return std::string(v.name); });
  if (found == kVerdicts.end())
    throw InputError(
        "{} has the verdict '{}'; expected reproduced, partly, undecided, not or not at this size", whose,
        name);
  return *found;
}

const Verdict& verdict_of(const nlohmann::json& claim) {
  return verdict_named(claim.value("verdict", ""), fmt::format("claim '{}'", claim.value("id", "?")));
}

std::size_t count(const nlohmann::json& claims, const Verdict& verdict) {
  return static_cast<std::size_t>(std::ranges::count_if(
      claims, [&](const nlohmann::json& claim) { return &verdict_of(claim) == &verdict; }));
}

}  // namespace

nlohmann::json claims_decided_by(const std::string& what, const nlohmann::json& claims) {
  nlohmann::json some = nlohmann::json::array();
  for (const nlohmann::json& claim : claims)
    if (claim.value("decided_by", "result") == what) some.push_back(claim);
  return some;
}

std::string verdict_tiles(const nlohmann::json& all) {
  const nlohmann::json claims = claims_decided_by("result", all);
  std::string html = "<div class=\"tiles\">\n";
  for (const Verdict& verdict : kVerdicts)
    html += fmt::format("<div class=\"tile {}\"><b>{}</b><span>{}&nbsp;{}</span></div>\n", verdict.css,
                        count(claims, verdict), verdict.sign, verdict.name);
  return html + "</div>\n";
}

std::string verdict_filters(const nlohmann::json& claims) {
  std::string html = fmt::format(
      "<div class=\"filters no-print\" role=\"group\" aria-label=\"Show claims by verdict\"><button "
      "type=\"button\" value=\"\" aria-pressed=\"true\">all {}</button>",
      claims.size());
  for (const Verdict& verdict : kVerdicts)
    if (const std::size_t n = count(claims, verdict))
      html += fmt::format("<button type=\"button\" value=\"{}\" aria-pressed=\"false\">{} {} {}</button>",
                          verdict.css, verdict.sign, verdict.name, n);
  return html + "</div>\n";
}

std::string verdict_badge(const std::string& name, const std::string& whose) {
  const Verdict& verdict = verdict_named(name, whose);
  return fmt::format("<span class=\"badge {}\">{} {}</span>", verdict.css, verdict.sign, verdict.name);
}

std::string verdict_class(const std::string& name) { return verdict_named(name, "a claim").css; }

}  // namespace hbr::inline reports
