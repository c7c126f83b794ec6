// The layers below the digits: points, lines and arcs (Fig. res_line).
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/figures/contender.h"
#include "reports/figures/figures.h"
#include "reports/figures/panels.h"
#include "reports/text/format.h"

namespace hbr::inline reports {
namespace {

void append(std::vector<Panel>& panels, std::vector<Panel> more) {
  for (Panel& panel : more) panels.push_back(std::move(panel));
}

// How much is still replaced once a repertoire is full, by the number of samples.
std::string replaced_in_words(const StatisticsView& statistics) {
  std::vector<std::string> shares, gains;
  for (const auto& [layer, samples] : {std::pair{"n1", "1 sample"}, {"n10", "10"}, {"n100", "100"}}) {
    const std::string prefix = fmt::format("layer3.{}.", layer);
    const std::vector<double> replaced = statistics.quantity(prefix + "replaced"),
                              gain = statistics.quantity(prefix + "late_gain");
    if (replaced.empty() || gain.empty()) return "";
    shares.push_back(
        fmt::format("{} % ({})", format_number(100 * summarise(replaced, "replaced").median, 2), samples));
    gains.push_back(format_number(summarise(gain, "late_gain").median, 2));
  }
  const auto test = statistics.test("layer3.n100.replaced", "layer3.n10.replaced");
  const bool told = test && test->p && *test->p < 0.05;
  return fmt::format(
      "<p>Of the arcs held at half of the generations {} have been replaced by the end; the mean fitness "
      "gained {} "
      "meanwhile. {}</p>\n",
      fmt::join(shares, ", "), fmt::join(gains, ", "),
      !told ? "Whether 100 samples replace fewer than 10 this run does not tell."
      : test->a12 < 0.5
          ? fmt::format("With 100 samples fewer are replaced than with 10 (p = {}).", format_p(*test->p))
          : fmt::format(
                "With 100 samples more are replaced than with 10 (p = {}), so a lack of replacements is not "
                "what keeps their mean down.",
                format_p(*test->p)));
}

// Of the elites held at each generation those that nothing replaced later.
std::vector<Panel> kept_panel(const StatisticsView& statistics, const std::string& figure, Tables& tables) {
  BandPlot plot{
      .x_label = "generation", .unit = "% of those held", .bands = {}, .from_zero = true, .width = 500};
  for (const char* search : {"layer3.n1", "layer3.n10", "layer3.n100", "flat_arcs"}) {
    auto band = statistics.curve(search, "replaced");
    if (!band) continue;
    const Contender who = contender(search);
    band->label = who.label;
    band->colour = who.colour;
    for (auto* values : {&band->q1, &band->median, &band->q3})
      for (double& value : *values) value = 100 * (1 - value);
    std::swap(band->q1, band->q3);
    add_band(tables, "Kept to the end", plot.x_label, *band);
    plot.bands.push_back(*band);
  }
  if (plot.bands.empty()) return {};
  return {{"Kept to the end", plot_script(plot, figure + "-kept"), 3}};
}

}  // namespace

Figure points_figure(const Evidence& evidence) {
  Figure figure{.id = "points", .title = "Layer 1: points"};
  figure.caption =
      "The repertoire that all others stand on: elites (a), the best (b) and the mean fitness (c), minus the "
      "variance of the joints. Median and quartiles over the replications.";
  figure.panels = progress_panels(evidence.statistics, {"layer1"}, figure.id, "rad²", figure.tables);
  if (figure.panels.empty()) figure.absent = "This run has no layer 1, so there is no curve to show.";
  return figure;
}

Figure lines_figure(const Evidence& evidence) {
  const std::vector<std::string> accuracy = {
      "accuracy.n1",   "accuracy.n10_short",          "accuracy.n10",
      "accuracy.n100", "accuracy.reference_endpoint", "accuracy.reference_displacement"};
  Figure figure{.id = "lines",
                .title = "Lines with and without the stochastic descriptor (the paper’s Fig. 5a)"};
  figure.caption =
      "a: squared error between the requested and the drawn displacement, the median over all requests, one "
      "value per replication. b: controllers in the repertoire. 4-D is the reference whose descriptor also "
      "holds the start; a stored line is replayed to its stored end or by its stored shift. Boxes: "
      "quartiles; "
      "whiskers: within 1.5 interquartile ranges; p: rank-sum tests between neighbours.";
  figure.panels =
      box_panel(evidence.statistics, accuracy,
                {.title = "Accuracy", .unit = "m²", .figure = figure.id, .logarithmic = true, .span = 3},
                figure.tables);
  append(
      figure.panels,
      box_panel(evidence.statistics,
                {"layer2.n1.size", "layer2.n10_short.size", "layer2.n10.size", "layer2.n100.size",
                 "reference4d.size"},
                {.title = "Size", .unit = "controllers", .figure = figure.id, .logarithmic = true, .span = 3},
                figure.tables));
  figure.notes = tests_table(evidence.statistics, accuracy);
  if (figure.panels.empty())
    figure.absent = "This run has no lines: neither layer 2 nor its accuracy was made.";
  return figure;
}

Figure arcs_figure(const Evidence& evidence) {
  Figure figure{.id = "arcs", .title = "Arcs with and without the hierarchy (the paper’s Fig. 5b)"};
  figure.caption =
      "Elites (a), best (b) and mean fitness (c) of layer 3 with 1, 10 and 100 samples and of a flat "
      "repertoire. The fitness is minus a sum of variances of segments, turns and joints, so it has no unit. "
      "Median and quartiles over the replications.";
  figure.panels =
      progress_panels(evidence.statistics, {"layer3.n1", "layer3.n10", "layer3.n100", "flat_arcs"}, figure.id,
                      "no unit", figure.tables);
  figure.notes = tests_table(evidence.statistics,
                             {"layer3.n1.mean", "layer3.n10.mean", "layer3.n100.mean", "flat_arcs.mean"});
  if (figure.panels.empty())
    figure.absent = "This run has no arcs: neither layer 3 nor the flat baseline was made.";
  return figure;
}

Figure arc_quality_figure(const Evidence& evidence) {
  Figure figure{.id = "arc_quality", .title = "The same arcs, executed again"};
  figure.caption =
      "Mean fitness of all stored arcs as the search recorded it (a), and when they are executed again from "
      "fresh starts (b). With a single sample the search keeps lucky draws. What the fitness from fresh "
      "starts "
      "is made of: the irregularity of segments and turns (c), and the joints’ term (d), which layer 1 "
      "already "
      "keeps small for the hierarchy. e: of the arcs that the search held at a generation those that it "
      "still held at "
      "its end, median and quartiles over the replications; a child takes an elite's place where it is "
      "better by "
      "epsilon. f: what the mean fitness gains in the second half of the generations. The others: "
      "one "
      "value per replication.";
  const auto of_each = [](const std::string& measure) {
    std::vector<std::string> names;
    for (const char* layer : {"layer3.n1.", "layer3.n10.", "layer3.n100.", "flat_arcs."})
      names.push_back(layer + measure);
    return names;
  };
  const std::vector<std::string> fresh = of_each("fresh_mean");
  if (evidence.statistics.quantities("layer3.", ".fresh_mean").empty()) {
    figure.absent = "This run did not execute its arcs again from fresh starts.";
    return figure;
  }
  figure.panels = box_panel(
      evidence.statistics, of_each("mean"),
      {.title = "As stored", .unit = "mean fitness, no unit", .figure = figure.id, .span = 3}, figure.tables);
  append(figure.panels,
         box_panel(
             evidence.statistics, fresh,
             {.title = "From fresh starts", .unit = "mean fitness, no unit", .figure = figure.id, .span = 3},
             figure.tables));
  for (const auto& [measure, title, unit] : {std::tuple{"irregularity", "Irregularity", "mean, no unit"},
                                             {"joint_term", "Joints’ term", "mean, rad²"}})
    append(figure.panels,
           box_panel(evidence.statistics, of_each(measure),
                     {.title = title, .unit = unit, .figure = figure.id, .span = 3}, figure.tables));
  append(figure.panels, kept_panel(evidence.statistics, figure.id, figure.tables));
  append(figure.panels, box_panel(evidence.statistics, of_each("late_gain"),
                                  {.title = "Gained in the second half",
                                   .unit = "mean fitness, no unit",
                                   .figure = figure.id,
                                   .span = 3},
                                  figure.tables));
  figure.notes = replaced_in_words(evidence.statistics) + tests_table(evidence.statistics, fresh);
  return figure;
}

}  // namespace hbr::inline reports
