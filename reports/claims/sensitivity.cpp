#include "reports/claims/sensitivity.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "pipeline/core/check.h"
#include "reports/claims/verdicts.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

using nlohmann::json;

json cell_of(const json& claim) {
  const std::string verdict = claim.at("verdict");
  const bool decided = verdict != "not at this size";
  json cell = {{"verdict", decided ? verdict : claim.at("indication").get<std::string>()},
               {"decided", decided},
               {"figures", json::array()},
               {"x", json::array()}};
  for (const json& check : claim.at("checks"))
    if (check.contains("x")) {
      cell["figures"].push_back(check.at("figure"));
      cell["x"].push_back(check.at("x"));
    }
  return cell;
}

const json& same_claim(const json& claim, std::size_t index, const VariationClaims& variation) {
  if (index >= variation.claims.size() || variation.claims[index].at("id") != claim.at("id"))
    throw InputError("variation '{}': its claims are not those of the run; expected '{}' at place {}",
                     variation.name, claim.at("id").get<std::string>(), index);
  return variation.claims[index];
}

// The figures of a cell, the unit once where all have it behind them.
std::string figures_html(const json& cell) {
  std::vector<std::string> figures = cell.at("figures").get<std::vector<std::string>>();
  const std::string times = " times";
  const auto ratio = [&](const std::string& figure) { return figure.ends_with(times); };
  if (std::ranges::all_of(figures, ratio))
    for (std::size_t i = 0; i + 1 < figures.size(); ++i) figures[i].resize(figures[i].size() - times.size());
  return escape_html(fmt::format("{}", fmt::join(figures, " · ")));
}

std::string cell_html(const json& cell, const json& base, bool is_base, const std::string& name) {
  const std::string verdict = cell.at("verdict");
  const std::string head = fmt::format("<td data-name=\"{}\"", escape_html(name));
  if (verdict.empty()) return head + ">–</td>";
  if (!is_base && cell == base) return head + " class=\"same\">as run</td>";
  const bool moved = !is_base && verdict != base.at("verdict").get<std::string>();
  return fmt::format("{}{}>{}<br>{}</td>", head, moved ? " class=\"moved\"" : "",
                     verdict_badge(verdict, "a claim"), figures_html(cell));
}

std::string row_html(const json& row, const json& variations) {
  const json& cells = row.at("cells");
  const bool moves = row.at("moves");
  std::string html =
      fmt::format("<tr{}><th scope=\"row\">{} <div class=\"place\"><a href=\"#claim-{}\">{}</a>{}</div></th>",
                  moves ? " class=\"moves\"" : "", escape_html(row.at("statement").get<std::string>()),
                  escape_html(row.at("id").get<std::string>()),
                  escape_html(row.at("place").get<std::string>()), moves ? " · <b>moves</b>" : "");
  for (std::size_t i = 0; i < cells.size(); ++i)
    html += cell_html(cells[i], cells[0], i == 0,
                      i == 0 ? "This run" : variations[i - 1].at("name").get<std::string>());
  return html + "</tr>\n";
}

}  // namespace

json sensitivity_table(const json& claims, const std::vector<VariationClaims>& variations) {
  json table = {{"variations", json::array()}, {"rows", json::array()}};
  for (const VariationClaims& v : variations)
    table["variations"].push_back({{"name", v.name}, {"changes", v.changes}});
  if (variations.empty()) return table;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const json& claim = claims[i];
    json cells = json::array({cell_of(claim)});
    bool answered = false, moves = false;
    for (const VariationClaims& v : variations) {
      cells.push_back(cell_of(same_claim(claim, i, v)));
      const json& verdict = cells.back()["verdict"];
      answered = answered || verdict != "";
      moves = moves || (verdict != "" && verdict != cells[0]["verdict"]);
    }
    if (answered && !claim.at("checks").empty())
      table["rows"].push_back({{"id", claim.at("id")},
                               {"statement", claim.at("statement")},
                               {"place", claim.at("place")},
                               {"moves", moves},
                               {"cells", cells}});
  }
  return table;
}

std::string sensitivity_html(const json& table) {
  const json& variations = table.at("variations");
  if (variations.empty()) return "";
  const auto moving =
      std::ranges::count_if(table.at("rows"), [](const json& row) { return row.at("moves").get<bool>(); });
  std::string readings, heads, rows;
  for (const json& v : variations) {
    const std::string name = escape_html(v.at("name").get<std::string>());
    const std::string changes = escape_html(v.at("changes").get<std::string>());
    readings += fmt::format("<dt><code>{}</code></dt><dd>{}</dd>\n", name, changes);
    heads += fmt::format("<th scope=\"col\" title=\"{}\"><code>{}</code></th>", changes, name);
  }
  for (const json& row : table.at("rows")) rows += row_html(row, variations);
  return fmt::format(
      "<section id=\"sensitivity\">\n<h2>Sensitivity</h2>\n"
      "<p>The same experiment with one reading changed at a time, each with the random numbers of this run. "
      "Of "
      "the {} claims that a variation answers {} {}. A sign is the claim’s verdict, or, where a run is "
      "smaller "
      "than the claim asks, what it points to; behind it stands what was measured, one figure for each of "
      "the "
      "claim’s checks. “As run” is the same to the last digit.</p>\n"
      "<dl class=\"variations\">\n{}</dl>\n<div class=\"scroll\"><table "
      "class=\"sensitivity\"><caption>Verdicts of this run and of its variations</caption><thead><tr>"
      "<th scope=\"col\">Claim</th><th scope=\"col\">This "
      "run</th>{}</tr></thead>\n<tbody>\n{}</tbody></table></div>\n</section>\n",
      table.at("rows").size(), moving, moving == 1 ? "moves" : "move", readings, heads, rows);
}

}  // namespace hbr::inline reports
