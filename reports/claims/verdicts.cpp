#include "reports/claims/verdicts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "pipeline/core/check.h"
#include "reports/text/html.h"

namespace hbr {
namespace {

// A sign beside the colour, for those who see no colours.
struct Verdict {
  const char *name, *sign, *css;
};
constexpr std::array<Verdict, 4> kVerdicts = {{{"reproduced", "✓", "reproduced"},
                                               {"partly", "◐", "partly"},
                                               {"not", "✗", "not"},
                                               {"not at this size", "○", "not-at-this-size"}}};

const Verdict& verdict_named(const std::string& name, const std::string& whose) {
  const auto found = std::ranges::find(kVerdicts, name, [](const Verdict& v) { return std::string(v.name); });
  if (found == kVerdicts.end())
    throw InputError("{} has the verdict '{}'; expected reproduced, partly, not or not at this size", whose,
                     name);
  return *found;
}

const Verdict& verdict_of(const nlohmann::json& claim) {
  return verdict_named(claim.value("verdict", ""), fmt::format("claim '{}'", claim.value("id", "?")));
}

std::string text(const nlohmann::json& claim, const char* key) {
  const auto found = claim.find(key);
  if (found == claim.end() || !found->is_string())
    throw InputError("claim '{}' has no text '{}'", claim.value("id", "?"), key);
  return escape_html(found->get<std::string>());
}

std::size_t count(const nlohmann::json& claims, const Verdict& verdict) {
  return static_cast<std::size_t>(std::ranges::count_if(
      claims, [&](const nlohmann::json& claim) { return &verdict_of(claim) == &verdict; }));
}

}  // namespace

std::string verdict_tiles(const nlohmann::json& claims) {
  std::string html = "<div class=\"tiles\">\n";
  for (const Verdict& verdict : kVerdicts)
    html += fmt::format("<div class=\"tile {}\"><b>{}</b><span>{} {}</span></div>\n", verdict.css,
                        count(claims, verdict), verdict.sign, verdict.name);
  return html + "</div>\n";
}

std::string verdict_badge(const std::string& name) {
  const Verdict verdict = verdict_named(name, "a claim");
  return fmt::format("<span class=\"badge {}\">{} {}</span>", verdict.css, verdict.sign, verdict.name);
}

std::string claims_table(const nlohmann::json& claims) {
  std::string html = fmt::format(
      "<div class=\"filters no-print\"><button type=\"button\" data-verdict=\"\" aria-pressed=\"true\">all "
      "{}</button>",
      claims.size());
  for (const Verdict& verdict : kVerdicts)
    if (const std::size_t n = count(claims, verdict))
      html +=
          fmt::format("<button type=\"button\" data-verdict=\"{}\" aria-pressed=\"false\">{} {} {}</button>",
                      verdict.css, verdict.sign, verdict.name, n);
  html +=
      "</div>\n<table class=\"claims\"><thead><tr><th>Claim</th><th>Paper</th><th>This run</th>"
      "<th>Verdict</th></tr></thead>\n<tbody>\n";
  for (const nlohmann::json& claim : claims) {
    const Verdict& verdict = verdict_of(claim);
    const std::string indication = text(claim, "indication");
    html += fmt::format(
        "<tr id=\"claim-{}\" data-verdict=\"{}\"><td>{} <div class=\"place\">{}</div></td><td "
        "data-name=\"Paper\">{}</td><td data-name=\"This run\">{}</td><td>{}{}<details "
        "class=\"reason\"><summary>why</summary>{}</details></td></tr>\n",
        text(claim, "id"), verdict.css, text(claim, "statement"), text(claim, "place"), text(claim, "paper"),
        text(claim, "ours"), verdict_badge(verdict.name),
        indication.empty() || indication == verdict.name
            ? ""
            : fmt::format(" <span class=\"indication\">points to: {}</span>", indication),
        text(claim, "reason"));
  }
  return html + "</tbody></table>\n";
}

}  // namespace hbr
