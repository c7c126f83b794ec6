#include "reports/figures/panels.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/figures/contender.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr {
namespace {

constexpr std::size_t kFew = 20;  // values that can be shown one by one

// "As stored" of figure "arc_quality" -> "arc_quality-as-stored": unique in the page.
std::string id_of(const std::string& figure, const std::string& title) {
  std::string id = figure + "-";
  for (const char c : title)
    id += (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') ? c
          : c >= 'A' && c <= 'Z'                           ? static_cast<char>(c + 32)
                                                           : '-';
  return id;
}

// Two words stand below each other under their box.
std::string broken(std::string label) {
  const std::size_t space = label.find(' ');
  if (space != std::string::npos) label[space] = '\n';
  return label;
}

void add_box(Table& table, const std::string& panel, const std::string& label, std::size_t i, const Box& box,
             double scale) {
  const auto x = static_cast<double>(i + 1);
  table.add(panel, label, x, "n", static_cast<double>(box.all.n));
  for (const auto& [quantity, value] :
       {std::pair{"minimum", box.all.minimum}, std::pair{"low", box.low}, std::pair{"q1", box.all.q1},
        std::pair{"median", box.all.median}, std::pair{"q3", box.all.q3}, std::pair{"high", box.high},
        std::pair{"maximum", box.all.maximum}})
    table.add(panel, label, x, quantity, value * scale);
}

Box scaled(Box box, double scale) {
  for (double* value :
       {&box.all.minimum, &box.all.q1, &box.all.median, &box.all.q3, &box.all.maximum, &box.low, &box.high})
    *value *= scale;
  return box;
}

struct Entry {
  std::string name;
  Box box;
  std::vector<double> points;
};

std::vector<Panel> draw_boxes(const StatisticsView& statistics, const std::vector<Entry>& entries,
                              const BoxOptions& options, Table& table) {
  if (entries.empty()) return {};
  BoxPlot plot{.unit = options.unit,
               .boxes = {},
               .brackets = {},
               .logarithmic = options.logarithmic,
               .from_zero = options.from_zero,
               .width = options.span == 2 ? 400.0 : 500.0};
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Contender who = contender(entries[i].name);
    add_box(table, options.title, who.label, i, entries[i].box, options.scale);
    std::vector<double> points = entries[i].points;
    for (double& value : points) value *= options.scale;
    plot.boxes.push_back({broken(who.label), who.colour, scaled(entries[i].box, options.scale), points});
    if (!options.brackets || i == 0) continue;
    if (const auto test = statistics.test(entries[i - 1].name, entries[i].name)) {
      if (test->p) plot.brackets.push_back({i - 1, i, "p = " + format_p(*test->p)});
    }
  }
  return {{options.title, plot_script(plot, id_of(options.figure, options.title)), options.span}};
}

}  // namespace

std::vector<Panel> progress_panels(const StatisticsView& statistics, const std::vector<std::string>& searches,
                                   const std::string& figure, Table& table) {
  static constexpr struct {
    const char *measure, *title, *unit;
  } kMeasures[] = {{"size", "Size", "elites"}, {"best", "Best", "fitness"}, {"mean", "Mean", "fitness"}};
  std::vector<Panel> panels;
  for (const auto& [measure, title, unit] : kMeasures) {
    BandPlot plot{
        .x_label = "generation", .unit = unit, .bands = {}, .from_zero = std::string(measure) == "size"};
    for (const std::string& search : searches) {
      auto band = statistics.curve(search, measure);
      if (!band) continue;
      const Contender who = contender(search);
      band->label = who.label;
      band->colour = who.colour;
      add_band(table, title, *band);
      plot.bands.push_back(*band);
    }
    if (!plot.bands.empty()) panels.push_back({title, plot_script(plot, id_of(figure, title)), 2});
  }
  return panels;
}

std::vector<Panel> box_panel(const StatisticsView& statistics, const std::vector<std::string>& names,
                             const BoxOptions& options, Table& table) {
  std::vector<Entry> entries;
  for (const std::string& name : names) {
    const std::vector<double> values = statistics.quantity(name);
    if (values.empty()) continue;
    entries.push_back(
        {name, box(values, name.c_str()), values.size() <= kFew ? values : std::vector<double>{}});
  }
  return draw_boxes(statistics, entries, options, table);
}

std::vector<Panel> pooled_box_panel(const StatisticsView& statistics, const std::vector<std::string>& names,
                                    const BoxOptions& options, Table& table) {
  std::vector<Entry> entries;
  for (const std::string& name : names)
    if (const auto box = statistics.box(name)) entries.push_back({name, *box, {}});
  return draw_boxes(statistics, entries, options, table);
}

std::string tests_table(const StatisticsView& statistics, const std::vector<std::string>& names) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t i = 0; i < names.size(); ++i)
    for (std::size_t k = i + 1; k < names.size(); ++k) {
      const auto test = statistics.test(names[i], names[k]);
      if (!test || !test->p) continue;
      rows.push_back({fmt::format("{} / {}", escape_html(contender(names[i]).label),
                                  escape_html(contender(names[k]).label)),
                      fmt::format("{} / {}", test->n_a, test->n_b),
                      test->ratio ? format_number(*test->ratio) : "–", format_p(*test->p),
                      format_number(test->a12)});
    }
  if (rows.empty()) return "";
  return "<details class=\"tests\"><summary>Rank-sum tests of every pair</summary>" +
         html_table(
             "Two-sided rank-sum tests over the replications (normal approximation, corrected for ties "
             "and continuity). A<sub>12</sub>: the chance that a value of a is greater than one of b",
             {"a / b", "n", "median a / median b", "p", "A<sub>12</sub>"}, rows) +
         "</details>\n";
}

}  // namespace hbr
