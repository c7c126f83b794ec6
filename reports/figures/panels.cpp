#include "reports/figures/panels.h"

#include <fmt/format.h>

#include <algorithm>

#include "reports/figures/contender.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
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

// A label of two lines in one.
std::string flat(std::string label) {
  std::ranges::replace(label, '\n', ' ');
  return label;
}

// Two words stand below each other under their box.
std::string broken(std::string label) {
  const std::size_t space = label.find(' ');
  if (space != std::string::npos) label[space] = '\n';
  return label;
}

struct Entry {
  std::string name;
  Box box;
  std::vector<double> values;  // one per replication
};

void add_to_tables(Tables& tables, const BoxOptions& options, const std::string& label, const Entry& entry) {
  Table::Row row{{"panel", options.title}, {"series", label}, {"unit", options.unit}};
  const Box& box = entry.box;
  row.emplace_back("n", static_cast<double>(box.all.n));
  for (const auto& [column, value] :
       {std::pair{"minimum", box.all.minimum}, std::pair{"low", box.low}, std::pair{"q1", box.all.q1},
        std::pair{"median", box.all.median}, std::pair{"q3", box.all.q3}, std::pair{"high", box.high},
        std::pair{"maximum", box.all.maximum}})
    row.emplace_back(column, value * options.scale);
  tables["boxes"].add(row);
  for (std::size_t r = 0; r < entry.values.size(); ++r)
    tables["values"].add({{"panel", options.title},
                          {"series", label},
                          {"unit", options.unit},
                          {"replication", static_cast<double>(r)},
                          {"value", entry.values[r] * options.scale}});
}

Box scaled(Box box, double scale) {
  for (double* value :
       {&box.all.minimum, &box.all.q1, &box.all.median, &box.all.q3, &box.all.maximum, &box.low, &box.high})
    *value *= scale;
  return box;
}

std::vector<Panel> draw_boxes(const StatisticsView& statistics, const std::vector<Entry>& entries,
                              const BoxOptions& options, Tables& tables) {
  if (entries.empty()) return {};
  BoxPlot plot{.unit = options.unit,
               .boxes = {},
               .brackets = {},
               .logarithmic = options.logarithmic,
               .from_zero = options.from_zero,
               .width = options.span == 2 ? 400.0 : 500.0};
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const Contender who = contender(entries[i].name);
    add_to_tables(tables, options, flat(who.label), entries[i]);
    std::vector<double> points = entries[i].values.size() <= kFew ? entries[i].values : std::vector<double>{};
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
                                   const std::string& figure, const std::string& unit, Tables& tables) {
  static constexpr struct {
    const char *measure, *title, *own_unit;
  } kMeasures[] = {{"size", "Size", "elites"}, {"best", "Best fitness", ""}, {"mean", "Mean fitness", ""}};
  std::vector<Panel> panels;
  for (const auto& [measure, title, own_unit] : kMeasures) {
    BandPlot plot{.x_label = "generation",
                  .unit = *own_unit ? own_unit : unit,
                  .bands = {},
                  .from_zero = std::string(measure) == "size"};
    for (const std::string& search : searches) {
      auto band = statistics.curve(search, measure);
      if (!band) continue;
      const Contender who = contender(search);
      band->label = who.label;
      band->colour = who.colour;
      add_band(tables, title, plot.x_label, *band);
      plot.bands.push_back(*band);
    }
    if (!plot.bands.empty()) panels.push_back({title, plot_script(plot, id_of(figure, title)), 2});
  }
  return panels;
}

std::vector<Panel> box_panel(const StatisticsView& statistics, const std::vector<std::string>& names,
                             const BoxOptions& options, Tables& tables) {
  std::vector<Entry> entries;
  for (const std::string& name : names) {
    const std::vector<double> values = statistics.quantity(name);
    if (values.empty()) continue;
    entries.push_back({name, box(values, name.c_str()), values});
  }
  return draw_boxes(statistics, entries, options, tables);
}

std::vector<Panel> pooled_box_panel(const StatisticsView& statistics, const std::vector<std::string>& names,
                                    const BoxOptions& options, Tables& tables) {
  std::vector<Entry> entries;
  for (const std::string& name : names)
    if (const auto box = statistics.box(name)) entries.push_back({name, *box, {}});
  return draw_boxes(statistics, entries, options, tables);
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
             "Two-sided rank-sum tests over the replications (exact for few of them, else by the normal "
             "approximation, corrected for ties and continuity). A<sub>12</sub>: the chance that a value of "
             "a is greater than one of b",
             {"a / b", "n", "median a / median b", "p", "A<sub>12</sub>"}, rows) +
         "</details>\n";
}

}  // namespace hbr::inline reports
