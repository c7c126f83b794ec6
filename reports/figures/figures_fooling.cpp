// How the network is fooled: its own error against what the judge says.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "reports/figures/contender.h"
#include "reports/figures/drawings.h"
#include "reports/figures/figures.h"
#include "reports/figures/panels.h"
#include "reports/plot/picture.h"
#include "reports/plot/plot_frame.h"
#include "reports/text/format.h"

namespace hbr::inline reports {
namespace {

constexpr std::array kDrawers = {"hbr", "flat"};
using Replications = std::vector<Drawings>;  // of one contender

// What both scatter plots show.
struct Bounds {
  double error = 0, low = 0, high = 0;  // errors from 0, confidences from low to high
};

Bounds bounds_of(const std::vector<Replications>& all) {
  std::vector<double> error, confidence;
  for (const Replications& contender : all)
    for (const Drawings& d : contender)
      for (std::size_t i = 0; i < d.size(); ++i) {
        error.push_back(-d.objective[i]);
        confidence.push_back(d.confidence[i]);
      }
  std::ranges::sort(error);
  std::ranges::sort(confidence);
  return {quantile(error, 0.995), std::min(0.0, quantile(confidence, 0.002)), confidence.back()};
}

// All elites of all replications as dots: good ones dark, the others pale.
Panel scatter(const std::string& who, const Replications& drawings, const Bounds& bounds,
              std::optional<double> real_error, Tables& tables) {
  constexpr double kLeft = 40, kBottom = 40, kWidth = 600, kTop = 6;
  constexpr int kScale = 2;
  const double width = kWidth - kLeft - 6, height = kPlotHeight + 60 - kBottom - kTop;
  const auto x = [&](double error) { return std::min(error / bounds.error, 1.0) * width; };
  const auto y = [&](double confidence) {
    return (1 - std::clamp((confidence - bounds.low) / (bounds.high - bounds.low), 0.0, 1.0)) * height;
  };
  const Contender contender = hbr::contender(who);
  const Colour colour = contender.colour;
  const auto rgb = static_cast<std::uint32_t>(std::stoul(hex(colour).substr(1), nullptr, 16));
  cv::Mat dots(cvRound(height * kScale), cvRound(width * kScale), CV_8UC4, cv::Scalar(0, 0, 0, 0));
  for (const bool good : {false, true})
    for (std::size_t r = 0; r < drawings.size(); ++r)
      for (std::size_t i = 0; i < drawings[r].size(); ++i) {
        const Drawings& d = drawings[r];
        if ((d.good[i] != 0) != good) continue;
        cv::circle(dots, {cvRound(x(-d.objective[i]) * kScale), cvRound(y(d.confidence[i]) * kScale)}, 3,
                   cv::Scalar(rgb & 255, rgb >> 8 & 255, rgb >> 16, good ? 210 : 70), cv::FILLED, cv::LINE_8);
        tables["digits"].add({{"series", contender.label},
                              {"good", good ? 1.0 : 0.0},
                              {"error", static_cast<double>(-d.objective[i])},
                              {"confidence", static_cast<double>(d.confidence[i])}});
      }
  std::string body = svg_image(encode_png(dots), kLeft, kTop, width, height, "photo");
  body += fmt::format(
      "<rect x=\"{}\" y=\"{}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"{}\"/>\n", kLeft,
      kTop, width, height, hex(Colour::faint));
  const auto line = [&](double x0, double y0, double x1, double y1) {
    body += fmt::format("<path d=\"M{:.1f} {:.1f}L{:.1f} {:.1f}\" stroke=\"{}\" stroke-dasharray=\"4 4\"/>\n",
                        kLeft + x0, kTop + y0, kLeft + x1, kTop + y1, hex(Colour::grey));
  };
  line(0, y(0), width, y(0));
  if (real_error && *real_error < bounds.error) {
    line(x(*real_error), 0, x(*real_error), height);
    body +=
        svg_text("real digits", kLeft + x(*real_error) + 5, kTop + height - 8, 13, Colour::grey, Align::left);
  }
  const std::vector<double> across = round_ticks(0, bounds.error), up = round_ticks(bounds.low, bounds.high);
  const std::vector<std::string> across_labels = tick_labels(across), up_labels = tick_labels(up);
  for (std::size_t i = 0; i < across.size(); ++i)
    body +=
        svg_text(across_labels[i], kLeft + x(across[i]), kTop + height + 17, 13, Colour::ink, Align::centre);
  for (std::size_t i = 0; i < up.size(); ++i)
    body += svg_text(up_labels[i], kLeft - 5, kTop + y(up[i]) + 5, 13, Colour::ink, Align::right);
  body += svg_text("the network’s error per pixel", kLeft + width / 2, kTop + height + 35, 13, Colour::ink,
                   Align::centre);
  return {
      contender.label + ": the judge’s confidence",
      Drawing{kWidth, kPlotHeight + 60, body,
              "A dot for each digit: the network’s error per pixel across, the judge’s confidence upwards; "
              "dark where the judge calls it good. The broken lines are confidence 0 and the error of real "
              "digits."},
      3};
}

// Share of good digits among those of about the same error, a band over replications for each contender.
std::vector<Panel> good_by_error(const std::vector<Replications>& all, const Bounds& bounds, Tables& tables) {
  constexpr double kBin = 0.004;
  constexpr std::size_t kFewest = 5;  // digits of a replication in a bin, for a share to say something
  BandPlot plot{.x_label = "the network’s error per pixel", .unit = "% good", .bands = {}, .from_zero = true};
  for (std::size_t c = 0; c < all.size(); ++c) {
    const Contender who = contender(kDrawers[c]);
    Band band{who.label, who.colour, {}, {}, {}, {}};
    for (double low = 0; low < bounds.error; low += kBin) {
      std::vector<double> shares;
      for (const Drawings& d : all[c]) {
        std::size_t in = 0, good = 0;
        for (std::size_t i = 0; i < d.size(); ++i)
          if (const double error = -d.objective[i]; error >= low && error < low + kBin)
            ++in, good += d.good[i];
        if (in >= kFewest) shares.push_back(100.0 * static_cast<double>(good) / static_cast<double>(in));
      }
      if (2 * shares.size() < all[c].size() || shares.empty()) continue;
      const Summary s = summarise(shares, "share of good digits");
      band.x.push_back(low + kBin / 2);
      band.q1.push_back(s.q1);
      band.median.push_back(s.median);
      band.q3.push_back(s.q3);
    }
    if (band.x.size() < 2) continue;
    add_band(tables, "Good digits by the network’s error", "error", band);
    plot.bands.push_back(band);
  }
  if (plot.bands.empty()) return {};
  return {{"Good digits by the network’s error", plot_script(plot, "fooling-good"), 2}};
}

// For each class as the judge sees it the two digits of least error, one good and one refused.
Panel pairs(const std::string& who, const Replications& drawings) {
  constexpr int kPixels = 112;
  constexpr double kEdge = 74, kWidth = 608, kSide = (kWidth - kEdge) / 10, kText = 16;
  InkSheet sheets[2] = {{10 * kPixels, kPixels}, {10 * kPixels, kPixels}};
  std::string body;
  for (int digit = 0; digit < 10; ++digit)
    for (const bool good : {true, false}) {
      const Drawings* from = nullptr;
      std::size_t best = 0;
      for (const Drawings& d : drawings)
        for (std::size_t i = 0; i < d.size(); ++i)
          if (d.label[i] == digit && (d.good[i] != 0) == good &&
              (!from || d.objective[i] > from->objective[best]))
            from = &d, best = i;
      if (!from) continue;
      const double row = good ? 0 : 1;
      sheets[good ? 0 : 1].place(from->image(best), (digit + 0.5) * kPixels, 0.5 * kPixels, kPixels);
      body += svg_text(fmt::format("{:.3f}", -from->objective[best]), kEdge + (digit + 0.5) * kSide,
                       (row + 1) * (kSide + kText) - 3, 13, Colour::grey, Align::centre);
    }
  for (const int row : {0, 1}) {
    const double top = row * (kSide + kText);
    body += sheets[row].svg_image(kEdge, top, 10 * kSide, kSide);
    body += svg_text(row == 0 ? "good" : "refused", 0, top + kSide / 2 + 5, 14, Colour::grey, Align::left);
  }
  return {
      contender(who).label + ": what the network likes best",
      Drawing{
          kWidth, 2 * (kSide + kText), body,
          "For each class from 0 to 9 the digit of least error that the judge calls good, and below it the "
          "one that it refuses, with their errors."},
      3};
}

}  // namespace

Figure fooling_figure(const Evidence& evidence) {
  Figure figure{.id = "fooling", .title = "How the network is fooled"};
  figure.caption =
      "a, b: every digit of all replications by the network’s error, which the search minimises, and the "
      "confidence of the judge, which it never sees; dark where the judge calls it good. Errors beyond "
      "their 99.5 % quantile stand on the right edge, the lowest confidences on the lower one. Below the "
      "level line the judge refuses; the upright line is the network’s mean error on real test images. "
      "c: how many of the digits with about the same error are good. d: rank correlation of the two "
      "opinions, and e: the mean confidence, one value per replication. f, g: for each class, as the judge "
      "sees it, the digit with the least error (written below it) among the good ones and among the "
      "others.";
  const auto files = evidence.artifacts.replications("digit_verdicts");
  std::vector<Replications> all;
  for (const char* who : kDrawers) {
    Replications drawings;
    for (const auto& path : files)
      if (has_drawings(path, who)) drawings.push_back(read_drawings(path, who));
    if (!drawings.empty()) all.push_back(std::move(drawings));
  }
  if (all.size() != kDrawers.size()) {
    figure.absent = "This run has no digits of both hierarchy and flat baseline that a judge has seen.";
    return figure;
  }
  const Bounds bounds = bounds_of(all);
  std::optional<double> real_error;
  if (const auto errors = evidence.statistics.quantity("autoencoder.test_error"); !errors.empty())
    real_error = summarise(errors, "autoencoder.test_error").median;
  for (std::size_t c = 0; c < all.size(); ++c)
    figure.panels.push_back(scatter(kDrawers[c], all[c], bounds, real_error, figure.tables));
  for (Panel& panel : good_by_error(all, bounds, figure.tables)) figure.panels.push_back(std::move(panel));
  for (const auto& [title, unit, measure] :
       {std::tuple{"Network and judge agree", "rank correlation", "agreement"},
        std::tuple{"The judge’s mean confidence", "margin, no unit", "confidence"}})
    for (Panel& panel : box_panel(
             evidence.statistics,
             {std::string("digit_verdicts.hbr.") + measure, std::string("digit_verdicts.flat.") + measure},
             {.title = title, .unit = unit, .figure = figure.id}, figure.tables))
      figure.panels.push_back(std::move(panel));
  for (std::size_t c = 0; c < all.size(); ++c) figure.panels.push_back(pairs(kDrawers[c], all[c]));
  return figure;
}

}  // namespace hbr::inline reports
