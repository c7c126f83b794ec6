// The digits (Fig. main_res) and what the judge says of them.
#include <fmt/format.h>

#include <algorithm>

#include "pipeline/core/check.h"
#include "reports/figures/contender.h"
#include "reports/figures/drawings.h"
#include "reports/figures/figures.h"
#include "reports/figures/panels.h"
#include "reports/plot/picture.h"

namespace hbr::inline reports {
namespace {

// Digits at their places in [-1, 1]^2, by the first two coordinates where there are more; pictures overlap
// where the latent space is crowded.
Panel mosaic(const std::string& title, const Drawings& digits, Tables& tables) {
  constexpr double kEdge = 22, kSide = 500;
  constexpr int kPixels = 900, kDigit = 40;
  InkSheet sheet(kPixels, kPixels);
  double good = 0;
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const auto [x, y] = digits.place(i);
    const double inner = kPixels - kDigit;
    sheet.place(digits.image(i), kDigit / 2.0 + (x + 1) / 2 * inner, kDigit / 2.0 + (1 - y) / 2 * inner,
                kDigit);
    good += digits.good[i];
    tables["elites"].add({{"panel", title},
                          {"elite", static_cast<double>(i)},
                          {"latent_x", x},
                          {"latent_y", y},
                          {"fitness", static_cast<double>(digits.objective[i])},
                          {"class", static_cast<double>(digits.label[i])},
                          {"good", static_cast<double>(digits.good[i])}});
  }
  return {title,
          Drawing{kEdge + kSide, kEdge + kSide,
                  sheet.svg_image(kEdge, 0, kSide, kSide) + square_axes(kEdge, 0, kSide),
                  fmt::format(
                      "The {} drawings of the repertoire, each at its place in the latent space; the judge "
                      "accepts {} of them as good digits.",
                      digits.size(), good)},
          3};
}

}  // namespace

Figure digits_figure(const Evidence& evidence) {
  Figure figure{.id = "digits", .title = "Digits drawn by the arm (the paper’s Fig. 3)"};
  figure.caption =
      "a, b: every elite of the first replication at its place in the latent space, by the hierarchy and by "
      "a "
      "flat repertoire. c to e: number of elites, best and mean fitness (minus the reconstruction error) "
      "over "
      "generations, median and quartiles over the replications.";
  const auto files = evidence.artifacts.replications("digit_verdicts");
  for (const auto& [who, title] : {std::pair{"hbr", "Hierarchy (HBR)"}, std::pair{"flat", "Flat repertoire"}})
    if (!files.empty() && has_drawings(files[0], who))
      figure.panels.push_back(mosaic(title, read_drawings(files[0], who), figure.tables));
  for (Panel& panel : progress_panels(evidence.statistics, {"layer4", "flat_digits"}, figure.id,
                                      "minus the squared error per pixel", figure.tables))
    figure.panels.push_back(std::move(panel));
  if (figure.panels.empty())
    figure.absent = "This run has no digits: neither layer 4 nor the flat baseline was made.";
  return figure;
}

Figure judge_figure(const Evidence& evidence) {
  Figure figure{.id = "judge", .title = "What a judge that the search never saw says"};
  figure.caption =
      "A digit is good if the classifier accepts it, it is as close to MNIST as 95 % of the test images are, "
      "and its neighbours agree. a: good digits of each class, median over the replications. b, c: share of "
      "good digits among all elites, and mean fitness, one value per replication.";
  BarPlot bars{.unit = "good digits", .x_label = "class", .groups = {}, .series = {}};
  for (int digit = 0; digit < 10; ++digit) bars.groups.push_back(std::to_string(digit));
  for (const char* who : {"hbr", "flat"}) {
    const Contender c = contender(who);
    BarSeries series{c.label, c.colour, {}};
    for (int digit = 0; digit < 10; ++digit) {
      const auto values =
          evidence.statistics.quantity(fmt::format("digit_verdicts.{}.good_of_class.{}", who, digit));
      if (values.empty()) break;
      series.values.push_back(summarise(values, "good_of_class").median);
      figure.tables["classes"].add({{"series", c.label},
                                    {"class", static_cast<double>(digit)},
                                    {"good_digits", series.values.back()}});
    }
    if (series.values.size() == bars.groups.size()) bars.series.push_back(series);
  }
  if (bars.series.empty()) {
    figure.absent = "No judge has looked at digits in this run.";
    return figure;
  }
  figure.panels.push_back({"Good digits by class", plot_script(bars, "judge-classes"), 2});
  const std::vector<std::string> good = {"digit_verdicts.hbr.good", "digit_verdicts.flat.good"},
                                 fitness = {"layer4.mean", "flat_digits.mean"};
  for (const auto& [title, unit, scale, names] :
       {std::tuple{"Share of good digits", "% of elites", 100.0, good},
        std::tuple{"Mean fitness", "minus the squared error per pixel", 1.0, fitness}})
    for (Panel& panel :
         box_panel(evidence.statistics, names,
                   {.title = title, .unit = unit, .figure = figure.id, .scale = scale}, figure.tables))
      figure.panels.push_back(std::move(panel));
  return figure;
}

std::vector<Figure> all_figures(const Evidence& evidence) {
  return {points_figure(evidence),       surest_digits_figure(evidence), autoencoder_figure(evidence),
          digits_figure(evidence),       continuum_figure(evidence),     judge_figure(evidence),
          turns_figure(evidence),        confusion_figure(evidence),     fooling_figure(evidence),
          substitution_figure(evidence), lines_figure(evidence),         arcs_figure(evidence),
          arc_quality_figure(evidence),  searches_figure(evidence),      numbers_figure(evidence),
          layers_figure(evidence)};
}

std::string best_digits_picture(const Artifacts& artifacts, int rows) {
  const auto files = artifacts.replications("digit_verdicts");
  if (files.empty() || !has_drawings(files[0], "hbr")) return "";
  struct Candidate {
    float confidence;
    std::size_t order;
    std::vector<std::uint8_t> image;
  };
  std::vector<std::vector<Candidate>> classes(10);
  std::size_t order = 0;
  for (const auto& path : files) {
    const Drawings digits = read_drawings(path, "hbr");
    for (std::size_t i = 0; i < digits.size(); ++i) {
      const auto image = digits.image(i);
      if (digits.good[i])
        classes.at(digits.label[i]).push_back({digits.confidence[i], order++, {image.begin(), image.end()}});
    }
  }
  constexpr int kCell = 84;
  const double cell = 60;
  InkSheet sheet(10 * kCell, rows * kCell);
  for (std::size_t digit = 0; digit < 10; ++digit) {
    std::ranges::sort(classes[digit], [](const Candidate& a, const Candidate& b) {
      return a.confidence != b.confidence ? a.confidence > b.confidence : a.order < b.order;
    });
    for (int row = 0; row < rows && static_cast<std::size_t>(row) < classes[digit].size(); ++row)
      sheet.place(classes[digit][static_cast<std::size_t>(row)].image,
                  (static_cast<double>(digit) + 0.5) * kCell, (row + 0.5) * kCell, kCell);
  }
  const Drawing drawing{10 * cell, rows * cell, sheet.svg_image(0, 0, 10 * cell, rows * cell),
                        fmt::format("One column for each class from 0 to 9, in it up to {} digits.", rows)};
  return inline_svg(drawing, "best-digits", "Digits drawn by the arm");
}

}  // namespace hbr::inline reports
