// The digits (Fig. main_res) and what the judge says of them.
#include <fmt/format.h>

#include <algorithm>

#include "pipeline/core/check.h"
#include "reports/figures/contender.h"
#include "reports/figures/drawings.h"
#include "reports/figures/figures.h"
#include "reports/figures/panels.h"
#include "reports/plot/picture.h"

namespace hbr {
namespace {

// Digits at their places in [-1, 1]^2, by the first two coordinates where there are more; pictures overlap
// where the latent space is crowded.
Panel mosaic(const std::string& title, const Drawings& digits, Table& table) {
  constexpr double kEdge = 22, kSide = 500;
  constexpr int kPixels = 900, kDigit = 40;
  InkSheet sheet(kPixels, kPixels);
  for (std::size_t i = 0; i < digits.size(); ++i) {
    const auto [x, y] = digits.place(i);
    const double inner = kPixels - kDigit;
    sheet.place(digits.image(i), kDigit / 2.0 + (x + 1) / 2 * inner, kDigit / 2.0 + (1 - y) / 2 * inner,
                kDigit);
    const auto row = static_cast<double>(i);
    table.add(title, "latent", row, "x", x);
    table.add(title, "latent", row, "y", y);
    table.add(title, "latent", row, "fitness", digits.objective[i]);
    table.add(title, "latent", row, "label", digits.label[i]);
    table.add(title, "latent", row, "good", digits.good[i]);
  }
  std::string body =
      fmt::format("<rect x=\"{0}\" y=\"0.5\" width=\"{1}\" height=\"{1}\" fill=\"none\" stroke=\"{2}\"/>\n",
                  kEdge - 0.5, kSide, hex(Colour::faint));
  body += sheet.svg_image(kEdge, 0, kSide, kSide);
  for (const auto& [label, share] : {std::pair{"−1", 0.0}, std::pair{"0", 0.5}, std::pair{"1", 1.0}}) {
    const Align along = share == 0 ? Align::left : share == 1 ? Align::right : Align::centre;
    body += svg_text(label, kEdge + share * kSide, kSide + 16, 13, Colour::grey, along);
    body += svg_text(label, kEdge - 5, 12 + (1 - share) * (kSide - 12), 13, Colour::grey, Align::right);
  }
  return {title, Drawing{kEdge + kSide, kEdge + kSide, body}, 3};
}

}  // namespace

Figure digits_figure(const Evidence& evidence) {
  Figure figure{.id = "digits", .title = "Digits drawn by the arm (the paper’s Fig. 3)."};
  figure.caption =
      "Above: every elite of the first replication at its place in the latent space, by the hierarchy and by "
      "a "
      "flat repertoire. Below: number of elites, best and mean fitness (minus the reconstruction error) over "
      "generations, median and quartiles over replications.";
  const auto files = evidence.artifacts.replications("digit_verdicts");
  for (const auto& [who, title] : {std::pair{"hbr", "Hierarchy (HBR)"}, std::pair{"flat", "Flat repertoire"}})
    if (!files.empty() && has_drawings(files[0], who))
      figure.panels.push_back(mosaic(title, read_drawings(files[0], who), figure.table));
  for (Panel& panel :
       progress_panels(evidence.statistics, {"layer4", "flat_digits"}, figure.id, figure.table))
    figure.panels.push_back(std::move(panel));
  if (figure.panels.empty())
    figure.absent = "This run has no digits: neither layer 4 nor the flat baseline was made.";
  return figure;
}

Figure judge_figure(const Evidence& evidence) {
  Figure figure{.id = "judge", .title = "What a judge that the search never saw says."};
  figure.caption =
      "A digit is good where the classifier, trained on the labels, accepts it, it lies as near to a real "
      "digit as "
      "95 % of the test images do, and its neighbours agree. Left: good digits of each class, median over "
      "replications. Middle and right: share of good digits among all elites and mean fitness, one value per "
      "replication.";
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
      figure.table.add("Good digits by class", c.label, digit, "median", series.values.back());
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
        std::tuple{"Mean fitness", "fitness", 1.0, fitness}})
    for (Panel& panel :
         box_panel(evidence.statistics, names,
                   {.title = title, .unit = unit, .figure = figure.id, .scale = scale}, figure.table))
      figure.panels.push_back(std::move(panel));
  return figure;
}

std::vector<Figure> all_figures(const Evidence& evidence) {
  return {points_figure(evidence),        searches_figure(evidence),    autoencoder_figure(evidence),
          surest_digits_figure(evidence), digits_figure(evidence),      continuum_figure(evidence),
          judge_figure(evidence),         fooling_figure(evidence),     substitution_figure(evidence),
          transfer_figure(evidence),      coverage_figure(evidence),    posture_figure(evidence),
          dynamics_figure(evidence),      tuned_figure(evidence),       lines_figure(evidence),
          arcs_figure(evidence),          arc_quality_figure(evidence), numbers_figure(evidence),
          layers_figure(evidence)};
}

std::string hero_picture(const Artifacts& artifacts, int rows) {
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
  const Drawing drawing{10 * cell, rows * cell, sheet.svg_image(0, 0, 10 * cell, rows * cell)};
  return inline_svg(drawing, "Digits drawn by the arm, one column for each class from 0 to 9");
}

}  // namespace hbr
