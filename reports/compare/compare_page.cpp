#include "reports/compare/compare_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "pipeline/statistics/summary.h"
#include "reports/claims/verdicts.h"
#include "reports/compare/differences.h"
#include "reports/page/assets.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

using nlohmann::json;

// Rows of one table, HTML.
struct Listing {
  std::string caption;
  std::vector<std::string> heads;
  std::vector<std::vector<std::string>> rows = {};

  std::string table() const { return html_table(caption, heads, rows); }
  // Closed at first; nothing where there are no rows.
  std::string folded(const std::string& summary) const {
    return rows.empty() ? "" : "<details><summary>" + summary + "</summary>\n" + table() + "</details>\n";
  }
};

std::string code(const std::string& text) {
  return text.empty() ? "–" : "<code>" + escape_html(text) + "</code>";
}

template <class Words>
std::string codes(const Words& words) {
  std::vector<std::string> all;
  for (const std::string& word : words) all.push_back(code(word));
  return all.empty() ? "–" : fmt::format("{}", fmt::join(all, ", "));
}

std::string count(std::size_t n, const char* one, const char* many) {
  return fmt::format("{} {}", n, n == 1 ? one : many);
}

std::string nothing(const char* text) { return fmt::format("<p class=\"absent\">{}</p>\n", text); }

std::string runs_html(const ComparedRun& a, const ComparedRun& b) {
  std::string html = "<dl class=\"variations\">\n", missing;
  for (const auto& [letter, run] : {std::pair("A", &a), std::pair("B", &b)}) {
    html += fmt::format("<dt>{}</dt><dd>{}{}, {}</dd>\n", letter, code(run->out.string()),
                        run->profile.empty() ? "" : ", profile <b>" + escape_html(run->profile) + "</b>",
                        count(run->manifests.size(), "artifact", "artifacts"));
    for (const std::string& sentence : run->missing)
      missing += fmt::format("<li><b>{}</b>: {}</li>\n", letter, escape_html(sentence));
  }
  html += "</dl>\n";
  return missing.empty() ? html : html + "<h3>What is missing</h3>\n<ul>\n" + missing + "</ul>\n";
}

std::string settings_html(const std::vector<SettingDifference>& differences) {
  if (differences.empty()) return nothing("The stages that both runs have were told the same.");
  Listing keys{"Keys of the profile as stages were told them", {"Key", "A", "B", "Stages"}};
  for (const SettingDifference& d : differences)
    keys.rows.push_back({code(d.key), code(d.a), code(d.b), codes(d.stages)});
  return keys.table();
}

std::string origins_html(const std::vector<OriginRow>& rows) {
  Listing words{"What made the artifacts, as their manifests have it", {"", "A", "B", ""}};
  for (const OriginRow& row : rows)
    words.rows.push_back(
        {row.word, codes(row.a), codes(row.b), row.a == row.b ? "the same" : "<b>differs</b>"});
  return words.table();
}

std::string bytes_of(const StageRow& row) {
  if (row.only_in_one()) return row.only_b == 0 ? "<b>only in A</b>" : "<b>only in B</b>";
  std::vector<std::string> parts;
  if (row.same > 0) parts.push_back(fmt::format("{} the same", row.same));
  for (const auto& [why, n] : row.others)
    parts.push_back(why.empty()
                        ? fmt::format("<b>{} differ although made from the same</b>", n)
                        : fmt::format("{} differ{}: other {}", n, n == 1 ? "s" : "", escape_html(why)));
  if (row.only_a > 0) parts.push_back(fmt::format("{} only in A", row.only_a));
  if (row.only_b > 0) parts.push_back(fmt::format("{} only in B", row.only_b));
  return fmt::format("{}", fmt::join(parts, "; "));
}

std::string stages_html(const std::vector<StageRow>& rows) {
  const std::vector<std::string> heads{"Stage", "Artifacts in A", "In B", "Bytes"};
  Listing other{"Stages whose artifacts differ", heads},
      same{"Stages with the same artifacts, byte for byte", heads};
  for (const StageRow& row : rows) {
    std::size_t both = row.same;
    for (const auto& [why, n] : row.others) both += n;
    (row.differs() ? other : same)
        .rows.push_back({code(row.stage), std::to_string(both + row.only_a),
                         std::to_string(both + row.only_b), bytes_of(row)});
  }
  return (other.rows.empty() ? nothing("All artifacts are the same, byte for byte.") : other.table()) +
         same.folded(count(same.rows.size(), "stage", "stages") + " with the same artifacts");
}

// What the run measured and what became of the claim.
std::vector<std::string> verdict_cells(const json& claim) {
  if (claim.is_null()) return {"–", "–"};
  const std::string verdict = claim.at("verdict"), indication = claim.value("indication", "");
  return {escape_html(claim.value("ours", "")),
          verdict_badge(verdict, "claim " + claim.value("id", "?")) +
              (indication.empty() || indication == verdict
                   ? ""
                   : " <span class=\"indication\">points to: " + escape_html(indication) + "</span>")};
}

std::string claims_html(const std::vector<ClaimRow>& rows) {
  const std::vector<std::string> heads{"Claim", "Figures of A", "Verdict of A", "Figures of B",
                                       "Verdict of B"};
  Listing moved{"Claims with another verdict, or that point elsewhere", heads},
      same{"Claims with the same verdict", heads}, one{"Claims with a verdict in one run only", heads};
  for (const ClaimRow& row : rows) {
    std::vector<std::string> cells{fmt::format("{} <div class=\"place\">{}</div>",
                                               escape_html(row.either().value("statement", "")),
                                               escape_html(row.either().value("place", "")))};
    for (const json& claim : {row.a, row.b})
      for (const std::string& cell : verdict_cells(claim)) cells.push_back(cell);
    (row.a.is_null() || row.b.is_null() ? one : row.moved() ? moved : same).rows.push_back(cells);
  }
  if (rows.empty()) return nothing("Neither run has verdicts yet.");
  if (one.rows.size() == rows.size()) return one.table();
  return (moved.rows.empty() ? nothing("No claim has another verdict.") : moved.table()) +
         one.folded(count(one.rows.size(), "claim", "claims") + " of one run only") +
         same.folded(count(same.rows.size(), "claim", "claims") + " with the same verdict");
}

std::string values_of(const std::vector<double>& values, const MeasureRow& row) {
  if (values.empty()) return "–";
  const Summary s = summarise(values, row.name.c_str());
  return escape_html(values.size() == 1 ? format_quantity(values[0], row.unit)
                                        : format_quartiles(s.median, s.q1, s.q3, row.unit)) +
         fmt::format(" <span class=\"indication\">n = {}</span>", values.size());
}

std::string difference_of(const MeasureRow& row) {
  const double a = summarise(row.a, row.name.c_str()).median, b = summarise(row.b, row.name.c_str()).median;
  std::string text = (b > a ? "+" : "") + format_quantity(b - a, row.unit);
  if (a != 0 && b != a)
    text += fmt::format(" ({}{} %)", b / a > 1 ? "+" : "", format_number(100 * (b / a - 1), 2));
  return escape_html(text);
}

// "0.84, p = 0.03"
std::string effect_of(const MeasureRow& row) {
  if (!row.test) return "–";
  return escape_html(fmt::format("{}, p = {}", format_number(row.test->a12, 2), format_p(row.test->p)));
}

std::string measures_html(const std::string& variation, const json& a, const json& b) {
  const std::vector<std::string> heads{"Quantity", "A", "B", "B less A", "B greater, test"};
  const std::string of = variation.empty() ? "" : " of the variation " + escape_html(variation);
  Listing other{"Quantities" + of + " that differ", heads},
      same{"Quantities" + of + " that are the same", heads},
      one{"Quantities" + of + " of one run only", heads};
  for (const MeasureRow& row : measure_rows(a, b)) {
    const bool both = !row.a.empty() && !row.b.empty();
    (!both        ? one
     : row.same() ? same
                  : other)
        .rows.push_back({fmt::format("<code>{}</code> <div class=\"place\">{}</div>", escape_html(row.name),
                                     escape_html(row.meaning)),
                         values_of(row.a, row), values_of(row.b, row), both ? difference_of(row) : "–",
                         effect_of(row)});
  }
  return (variation.empty() ? "" : "<h3>Variation " + code(variation) + "</h3>\n") +
         (other.rows.empty() ? nothing("No quantity that both runs have differs.") : other.table()) +
         one.folded(count(one.rows.size(), "quantity", "quantities") + " of one run only") +
         same.folded(count(same.rows.size(), "quantity", "quantities") + " that both have alike");
}

std::string all_measures_html(const ComparedRun& a, const ComparedRun& b) {
  std::string html;
  std::vector<std::string> one;
  for (const auto& [variation, of_a] : a.statistics) {
    const auto of_b = b.statistics.find(variation);
    if (of_b != b.statistics.end())
      html += measures_html(variation, of_a, of_b->second);
    else if (!variation.empty())
      one.push_back(variation + " (A)");
  }
  for (const auto& [variation, of_b] : b.statistics)
    if (!variation.empty() && !a.statistics.contains(variation)) one.push_back(variation + " (B)");
  if (html.empty()) html = nothing("The two runs have no statistics in common.");
  if (!one.empty()) html += fmt::format("<p>Variations of one run only: {}.</p>\n", codes(one));
  return html;
}

std::string tile(std::size_t n, const char* what) {
  return fmt::format("<div class=\"tile\"><b>{}</b><span>{}</span></div>\n", n, what);
}

// What differs, counted.
std::string summary_html(const ComparedRun& a, const ComparedRun& b,
                         const std::vector<SettingDifference>& settings, const std::vector<StageRow>& stages,
                         const std::vector<ClaimRow>& claims) {
  std::size_t same = 0, others = 0, one = 0;
  for (const StageRow& row : stages) {
    same += row.same;
    one += row.only_in_one();
    for (const auto& [why, n] : row.others) others += n;
  }
  return runs_html(a, b) + "<div class=\"tiles\">\n" + tile(settings.size(), "settings differ") +
         tile(static_cast<std::size_t>(std::ranges::count_if(claims, &ClaimRow::moved)), "claims moved") +
         tile(others, "artifacts with other bytes") + tile(same, "artifacts with the same bytes") +
         tile(one, "stages in one run only") + "</div>\n";
}

}  // namespace

std::string compare_page(const ComparedRun& a, const ComparedRun& b) {
  const std::vector<SettingDifference> settings = setting_differences(a, b);
  const std::vector<StageRow> stages = stage_rows(a, b);
  const std::vector<ClaimRow> claims = claim_rows(a, b);
  const auto section = [](const char* id, const char* title, const std::string& lead,
                          const std::string& body) {
    return fmt::format(
        "<section id=\"{}\" aria-labelledby=\"{}-title\">\n<h2 id=\"{}-title\">{}</h2>\n{}{}</section>\n\n",
        id, id, id, title, lead.empty() ? "" : "<p>" + lead + "</p>\n", body);
  };
  return fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<title>Two runs compared: {0} and {1}</title>\n<style>\n{2}</style>\n"
      "<noscript><style>#theme {{ display: none; }}</style></noscript>\n</head>\n<body>\n"
      "<header><div class=\"inner\">\n<p class=\"kicker\">Two runs compared</p>\n<h1>{0} and {1}</h1>\n"
      "</div></header>\n<nav aria-label=\"Sections\"><div class=\"inner\">\n<a href=\"#summary\">Summary</a> "
      "<a href=\"#settings\">Settings</a> <a href=\"#claims\">Claims</a> <a "
      "href=\"#quantities\">Quantities</a> "
      "<a href=\"#artifacts\">Artifacts</a> <a href=\"#origin\">Origin</a>\n"
      "<button id=\"theme\" type=\"button\" aria-label=\"Switch between light and dark\">◐</button>\n"
      "</div></nav>\n<main>\n\n{3}</main>\n<script>\n{4}</script>\n</body>\n</html>\n",
      escape_html(a.out.string()), escape_html(b.out.string()), kPageCss,
      section("summary", "What differs", "", summary_html(a, b, settings, stages, claims)) +
          section(
              "settings", "Settings",
              "Every stage is told the part of the profile that it depends on; what both runs have made is "
              "compared key by key.",
              settings_html(settings)) +
          section("claims", "Claims of the paper", "", claims_html(claims)) +
          section(
              "quantities", "Quantities",
              "Median and quartiles over the replications. The last column is the share of all pairs of "
              "replications in which that of B is greater (0.5: neither), with the p-value of the rank-sum "
              "test of this quantity alone: of many quantities that do not differ, one in twenty has p below "
              "0.05. The greatest effects stand first.",
              all_measures_html(a, b)) +
          section(
              "artifacts", "Artifacts",
              "By the hashes in their manifests. What an artifact was made from otherwise is its settings, "
              "its program, its inputs or the sources that it read.",
              stages_html(stages)) +
          section("origin", "Versions, compilers, hosts", "", origins_html(origins(a, b))),
      kPageJs);
}

}  // namespace hbr::inline reports
