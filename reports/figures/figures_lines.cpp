// The layers below the digits: points, lines and arcs (Fig. res_line).
#include "reports/figures/figures.h"
#include "reports/figures/panels.h"

namespace hbr {
namespace {

void append(std::vector<Panel>& panels, std::vector<Panel> more) {
  for (Panel& panel : more) panels.push_back(std::move(panel));
}

}  // namespace

Figure points_figure(const Evidence& evidence) {
  Figure figure{.id = "points", .title = "Layer 1: points."};
  figure.caption =
      "Size, best and mean fitness (minus the variance of the joints, rad²) of the repertoire that "
      "all others stand on: median and quartiles over replications.";
  figure.panels = progress_panels(evidence.statistics, {"layer1"}, figure.id, figure.table);
  if (figure.panels.empty()) figure.absent = "This run has no layer 1, so there is no curve to show.";
  return figure;
}

Figure lines_figure(const Evidence& evidence) {
  const std::vector<std::string> accuracy = {
      "accuracy.n1",   "accuracy.n10_short",          "accuracy.n10",
      "accuracy.n100", "accuracy.reference_endpoint", "accuracy.reference_displacement"};
  Figure figure{.id = "lines",
                .title = "Lines with and without the stochastic descriptor (the paper’s Fig. 5a)."};
  figure.caption =
      "Left: squared error between requested and drawn displacement, the median over all requests, one value "
      "per "
      "replication. 4-D is the reference whose descriptor also holds the start: replayed to its stored end, "
      "or by its "
      "stored shift. Right: controllers in the repertoire. Boxes: quartiles; whiskers: within 1.5 "
      "interquartile "
      "ranges; p: rank-sum tests between neighbours.";
  figure.panels = box_panel(
      evidence.statistics, accuracy,
      {.title = "Accuracy", .unit = "m²", .figure = figure.id, .logarithmic = true, .span = 3}, figure.table);
  append(
      figure.panels,
      box_panel(evidence.statistics,
                {"layer2.n1.size", "layer2.n10_short.size", "layer2.n10.size", "layer2.n100.size",
                 "reference4d.size"},
                {.title = "Size", .unit = "controllers", .figure = figure.id, .logarithmic = true, .span = 3},
                figure.table));
  figure.notes = tests_table(evidence.statistics, accuracy);
  if (figure.panels.empty())
    figure.absent = "This run has no lines: neither layer 2 nor its accuracy was made.";
  return figure;
}

Figure arcs_figure(const Evidence& evidence) {
  Figure figure{.id = "arcs", .title = "Arcs with and without the hierarchy (the paper’s Fig. 5b)."};
  figure.caption =
      "Number of behaviours, best and mean fitness: layer 3 with 1, 10 and 100 samples against a flat "
      "repertoire of 40 genes. Median and quartiles over replications.";
  figure.panels = progress_panels(
      evidence.statistics, {"layer3.n1", "layer3.n10", "layer3.n100", "flat_arcs"}, figure.id, figure.table);
  figure.notes = tests_table(evidence.statistics,
                             {"layer3.n1.mean", "layer3.n10.mean", "layer3.n100.mean", "flat_arcs.mean"});
  if (figure.panels.empty())
    figure.absent = "This run has no arcs: neither layer 3 nor the flat baseline was made.";
  return figure;
}

Figure arc_quality_figure(const Evidence& evidence) {
  Figure figure{.id = "arc_quality", .title = "The same arcs, executed again."};
  figure.caption =
      "Mean fitness of all stored arcs as the search recorded it, and when executed again from fresh "
      "starts: a single sample keeps lucky draws. One value per replication.";
  const std::vector<std::string> fresh = {"layer3.n1.fresh_mean", "layer3.n10.fresh_mean",
                                          "layer3.n100.fresh_mean", "flat_arcs.fresh_mean"};
  if (evidence.statistics.quantities("layer3.", ".fresh_mean").empty()) {
    figure.absent = "This run did not execute its arcs again from fresh starts.";
    return figure;
  }
  figure.panels = box_panel(
      evidence.statistics, {"layer3.n1.mean", "layer3.n10.mean", "layer3.n100.mean", "flat_arcs.mean"},
      {.title = "As stored", .unit = "mean fitness", .figure = figure.id, .span = 3}, figure.table);
  append(figure.panels,
         box_panel(evidence.statistics, fresh,
                   {.title = "From fresh starts", .unit = "mean fitness", .figure = figure.id, .span = 3},
                   figure.table));
  figure.notes = tests_table(evidence.statistics, fresh);
  return figure;
}

}  // namespace hbr
