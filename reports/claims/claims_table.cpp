#include "reports/claims/claims_table.h"

#include <fmt/format.h>

#include "pipeline/core/check.h"
#include "pipeline/statistics/rank_sum.h"
#include "reports/claims/range_chart.h"
#include "reports/claims/verdicts.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

using nlohmann::json;

std::string text(const json& entry, const std::string& whose, const char* key) {
  const auto found = entry.find(key);
  if (found == entry.end() || !found->is_string())
    throw InputError("claim '{}' has no text '{}'", whose, key);
  return escape_html(found->get<std::string>());
}

// One sign and word for what came of a check.
std::string outcome(const std::string& name) {
  if (name == "yes") return "<span class=\"reproduced\">✓ holds</span>";
  if (name == "partly") return "<span class=\"partly\">◐ in part</span>";
  if (name == "undecided") return "<span class=\"undecided\">? not told from chance</span>";
  if (name == "no") return "<span class=\"not\">✗ does not hold</span>";
  return "<span class=\"not-at-this-size\">○ not measured</span>";
}

std::string check_row(const json& check, const std::string& id) {
  return fmt::format(
      "<tr class=\"check\"><td>{}</td><td data-name=\"asked\">{}</td><td data-name=\"this run\">{}</td>"
      "<td>{}</td><td>{}</td></tr>\n",
      text(check, id, "words"), text(check, id, "asked"), text(check, id, "ours"),
      check.contains("x") ? range_chart(check) : "", outcome(check.value("outcome", "absent")));
}

// The claim itself in the whole width; what is behind its verdict is folded.
std::string claim_rows(const json& claim) {
  const std::string id = claim.value("id", "?"), verdict = claim.value("verdict", ""),
                    indication = text(claim, id, "indication"), paper = text(claim, id, "paper");
  const std::string badge = verdict_badge(verdict, fmt::format("claim '{}'", id));
  std::string html = fmt::format(
      "<tbody id=\"claim-{}\" data-verdict=\"{}\">\n<tr class=\"claim\"><th colspan=\"5\" scope=\"rowgroup\">"
      "<details><summary><span class=\"statement\">{} <span class=\"place\">{}</span></span>{} <span "
      "class=\"verdict\">{}{}</span></summary><p>{}</p></details></th></tr>\n",
      escape_html(id), verdict_class(verdict), text(claim, id, "statement"), text(claim, id, "place"),
      paper.empty() ? "" : fmt::format(" <span class=\"paper\">paper: {}</span>", paper), badge,
      indication.empty() || indication == verdict
          ? ""
          : fmt::format(" <span class=\"indication\">points to: {}</span>", indication),
      text(claim, id, "reason"));
  if (!claim.contains("checks")) throw InputError("claim '{}' has no checks", id);
  for (const json& check : claim.at("checks")) html += check_row(check, id);
  return html + "</tbody>\n";
}

std::string table(const std::string& caption, const json& claims) {
  std::string html = fmt::format(
      "<table class=\"claims\"><caption>{}</caption>\n<thead><tr><th scope=\"col\">What is compared</th><th "
      "scope=\"col\">Reproduced if</th><th scope=\"col\">This run</th><th scope=\"col\">Chart</th><th "
      "scope=\"col\">Outcome</th></tr></thead>\n",
      caption);
  for (const json& claim : claims) html += claim_rows(claim);
  return html + "</table>\n";
}

}  // namespace

std::string claims_table(const json& claims) {
  const json results = claims_decided_by("result", claims), design = claims_decided_by("design", claims),
             ours = claims_decided_by("ours", claims);
  std::string html =
      verdict_filters(results) +
      table(
          "Each claim, and below it what is compared. In the charts the dark bar is what counts as "
          "reproduced, the pale one what counts in part (where a test is asked for, if its p, adjusted, is "
          "below 0.05; else the check is undecided), the dot this run. A dot beyond both does not hold, "
          "whatever the test says. p: two-sided rank-sum test over the replications (exact for up to " +
              std::to_string(kSmall) +
              " values, else the normal approximation, corrected for ties and continuity, as in "
              "the paper), adjusted for all the tests here that decide (Holm 1979) unless it is the "
              "least that this test can give for so few, which counts as small enough; none is given for "
              "fewer than " +
              std::to_string(kFewestToTest) +
              " replications. In brackets: of what is computed from two quantities the 95 % confidence "
              "interval, by bootstrap; of one quantity the quartiles over the replications.",
          results);
  if (!ours.empty())
    html += "<details id=\"ours\"><summary>What we ask besides</summary>\n" +
            table(
                "Other readings of the paper's sentences, and questions that it does not ask: decided by the "
                "same rules, but not counted among its claims.",
                ours) +
            "</details>\n";
  if (!design.empty())
    html += "<details id=\"design\"><summary>Facts of the design</summary>\n" +
            table(
                "What the paper says of its experiment and the settings here decide, whatever comes out: "
                "compared, but not counted among the verdicts.",
                design) +
            "</details>\n";
  return html;
}

}  // namespace hbr::inline reports
