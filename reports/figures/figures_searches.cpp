// Layer 1 by other containers and selectors.
#include <fmt/format.h>

#include <algorithm>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/statistics/summary.h"
#include "reports/figures/contender.h"
#include "reports/figures/figures.h"
#include "reports/figures/panels.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

const std::string kPrefix = "layer1_search.";

// "layer1_search.NAME", the highest median QD score first.
std::vector<std::string> compared(const StatisticsView& statistics) {
  const std::string suffix = ".qd_score";
  std::vector<std::pair<double, std::string>> found;
  for (const std::string& name : statistics.quantities(kPrefix, suffix))
    found.emplace_back(-summarise(statistics.quantity(name), name.c_str()).median,
                       name.substr(0, name.size() - suffix.size()));
  std::sort(found.begin(), found.end());
  std::vector<std::string> searches;
  for (const auto& [score, search] : found) searches.push_back(search);
  return searches;
}

std::vector<std::string> each(const std::vector<std::string>& searches, const char* measure) {
  std::vector<std::string> names;
  for (const std::string& search : searches) names.push_back(search + "." + measure);
  return names;
}

// "distance", "curiosity": what the search is made of, as its artifact says.
std::string part(const Artifacts& artifacts, const std::string& search, const char* key) {
  const auto files = artifacts.replications("layer1_search_" + search.substr(kPrefix.size()));
  if (files.empty()) return "–";
  const Hdf5Reader file(files.front());
  const std::string attribute = std::string("settings.search.") + key;
  return file.has_attribute(attribute) ? file.text_attribute(attribute) : "–";
}

std::string quartiles(const StatisticsView& statistics, const std::string& name, double scale,
                      const char* unit) {
  const std::vector<double> values = statistics.quantity(name);
  if (values.empty()) return "–";
  const Summary s = summarise(values, name.c_str());
  return format_quartiles(scale * s.median, scale * s.q1, scale * s.q3, unit);
}

std::string table_of(const Evidence& evidence, const std::vector<std::string>& searches) {
  std::vector<std::vector<std::string>> rows;
  for (const std::string& search : searches)
    rows.push_back({escape_html(contender(search).label),
                    escape_html(part(evidence.artifacts, search, "container")),
                    escape_html(part(evidence.artifacts, search, "selector")),
                    quartiles(evidence.statistics, search + ".coverage", 100, "%"),
                    quartiles(evidence.statistics, search + ".qd_score", 1, ""),
                    quartiles(evidence.statistics, search + ".cell_mean", 1, ""),
                    quartiles(evidence.statistics, search + ".mean", 1, ""),
                    quartiles(evidence.statistics, search + ".size", 1, "")});
  return html_table("Median and quartiles over the replications; fitness and QD score in rad²",
                    {"Search", "Container", "Selector", "Coverage", "QD score", "Mean fitness, common cells",
                     "Mean fitness, own elites", "Elites"},
                    rows);
}

}  // namespace

Figure searches_figure(const Evidence& evidence) {
  Figure figure{.id = "searches", .title = "Layer 1 by other searches"};
  figure.caption =
      "The same arm, variation, children and generations: only container and selector differ. All "
      "repertoires are projected onto one grid, where the fittest of each cell counts. Coverage (a): share "
      "of "
      "the cells that any search fills. QD score (b): sum over the cells of the best fitness above the worst "
      "possible. Blue: the unstructured archive; green: the same with local competition; orange: grid; "
      "purple: "
      "CVT. One value per replication, the highest QD score first.";
  const std::vector<std::string> searches = compared(evidence.statistics);
  if (searches.empty()) {
    figure.absent = "This run compared no searches.";
    return figure;
  }
  struct Measure {
    const char *name, *title, *unit;
    double scale;
  };
  for (const auto& [name, title, unit, scale] :
       {Measure{"coverage", "Coverage", "%", 100}, Measure{"qd_score", "QD score", "rad²", 1},
        Measure{"mean", "Mean fitness of the elites", "rad²", 1}, Measure{"size", "Size", "elites", 1}}) {
    std::vector<Panel> panel = box_panel(
        evidence.statistics, each(searches, name),
        {.title = title, .unit = unit, .figure = figure.id, .scale = scale, .brackets = false, .span = 3},
        figure.tables);
    for (Panel& p : panel) figure.panels.push_back(std::move(p));
  }
  figure.notes = table_of(evidence, searches) + tests_table(evidence.statistics, each(searches, "qd_score"));
  return figure;
}

}  // namespace hbr::inline reports
