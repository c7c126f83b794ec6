#include "reports/page/report.h"

#include <fmt/format.h>

#include "pipeline/artifact/content.h"
#include "pipeline/core/file_error.h"
#include "reports/claims/claims_table.h"
#include "reports/claims/ledger.h"
#include "reports/claims/verdicts.h"
#include "reports/figures/figures.h"
#include "reports/kept/speed.h"
#include "reports/page/assets.h"
#include "reports/page/explorer.h"
#include "reports/page/robots.h"
#include "reports/page/robots3d.h"
#include "reports/readings/study_html.h"
#include "reports/text/html.h"
#include "reports/text/template.h"

namespace hbr::inline reports {
namespace {

std::string best_digits(const Artifacts& artifacts) {
  const std::string picture = best_digits_picture(artifacts, 3);
  if (picture.empty()) return "<p class=\"absent\">This run drew no digits.</p>";
  return "<div class=\"best-digits\">" + picture +
         "<p>Drawn by the arm’s hierarchy: for each class the three digits that the judge is most certain "
         "of, over all "
         "replications. An empty place is a digit that the run did not find.</p></div>";
}

// What the run is made of, stage by stage.
std::string inventory(const ReportContent& content) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& stage : content.artifacts.stages(""))
    rows.push_back({fmt::format("<code>{}</code>", escape_html(stage)),
                    fmt::format("{}", content.artifacts.replications(stage).size())});
  return fmt::format(
      "<p>Profile <b>{}</b>. What stands above is a function of the profile, the data and the programs "
      "alone; the same three give the same bytes.</p>\n<details><summary>Stages and their "
      "replications</summary>{}</details>\n",
      escape_html(content.profile),
      html_table("Replications of each stage", {"Stage", "Replications"}, rows));
}

}  // namespace

void write_report(const ReportContent& content, const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder / "figures", error);
  if (error) throw file_error(folder / "figures", "can't make this folder", error.value());

  const nlohmann::json sensitivity = sensitivity_table(content.claims, content.variations);
  const Evidence evidence{content.artifacts, StatisticsView(content.statistics)};
  TemplateContent page;
  page.statistics = content.statistics;
  page.values = {
      {"profile", escape_html(content.profile)},
      {"css", kPageCss},
      {"js", kPageJs},
      {"packs", explorer_packs(content.artifacts, content.profile) +
                    robots_3d_packs(content.artifacts, content.three)},
      {"explorer", explorer_html(content.artifacts)},
      {"robots3d", robots_3d_html(content.artifacts, content.three)},
      {"best_digits", best_digits(content.artifacts)},
      {"hierarchy", hierarchy_diagram(content.layers)},
      {"verdicts", verdict_tiles(content.claims)},
      {"layers", layers_table(content.layers, evidence)},
      {"claims", claims_table(content.claims)},
      {"sensitivity", sensitivity_html(sensitivity)},
      {"sensitivity_link", content.variations.empty() ? "" : "<a href=\"#sensitivity\">Sensitivity</a> "},
      {"study", study_html(content.study, content.readings)},
      {"study_link", content.study.is_null() ? "" : "<a href=\"#readings-study\">Study</a> "},
      {"readings", ledger_html(content.readings)},
      {"speed", speed_html(content.speed)},
      {"provenance", inventory(content)}};
  std::vector<Figure> figures = all_figures(evidence);
  const std::size_t own = figures.size();
  for (const std::string& robot : content.robots)
    for (Figure& figure : robot_figures(evidence, robot)) figures.push_back(std::move(figure));
  draw_plots(figures);
  for (const Figure& figure : figures) write_figure(figure, folder / "figures");
  for (std::size_t i = 0; i < own; ++i) page.figures[figures[i].id] = figure_html(figures[i]);
  std::string& robots = page.values["robots"];
  const std::size_t each = content.robots.empty() ? 0 : (figures.size() - own) / content.robots.size();
  for (std::size_t r = 0; r < content.robots.size(); ++r) {
    const auto first = figures.begin() + static_cast<std::ptrdiff_t>(own + r * each);
    robots += robot_html(content.robots[r], {first, first + static_cast<std::ptrdiff_t>(each)});
  }
  if (content.robots.empty()) robots = "<p class=\"absent\">This run has no robot but the arm.</p>\n";
  write_file(folder / "index.html", fill_template(kPageHtml, page));
  write_file(folder / "statistics.json", content.statistics.dump(1) + "\n");
  write_file(folder / "claims.json", content.claims.dump(1) + "\n");
  if (!content.speed.is_null()) write_file(folder / "speed.json", content.speed.dump(1) + "\n");
  if (!content.study.is_null()) write_file(folder / "readings.json", content.study.dump(1) + "\n");
  if (!content.variations.empty()) write_file(folder / "sensitivity.json", sensitivity.dump(1) + "\n");
}

}  // namespace hbr::inline reports
