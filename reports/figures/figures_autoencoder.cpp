// The learned descriptor: training, latent space, reconstructions (Fig. notation, bottom).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "reports/figures/figures.h"
#include "reports/plot/picture.h"
#include "reports/plot/plot_frame.h"

namespace hbr::inline reports {
namespace {

// Ten hues of equal weight; the classes are named where they lie, so colour alone carries nothing.
constexpr std::array<std::uint32_t, 10> kClassColours = {0x0072b2, 0xe69f00, 0x009e73, 0xcc79a7, 0xd55e00,
                                                         0x56b4e9, 0x8c6bb1, 0x7a8088, 0x9a7b4f, 0xb5bd00};

std::vector<Panel> learning_panel(const StatisticsView& statistics, Tables& tables) {
  BandPlot plot{.x_label = "epoch", .unit = "squared error per pixel", .bands = {}};
  for (const auto& [label, colour, measure] :
       {std::tuple{"test", Colour::blue, "test_error"}, std::tuple{"train", Colour::orange, "train_error"}}) {
    auto band = statistics.curve("autoencoder", measure);
    if (!band) continue;
    band->label = label;
    band->colour = colour;
    add_band(tables, "Learning", plot.x_label, *band);
    plot.bands.push_back(*band);
  }
  if (plot.bands.empty()) return {};
  return {{"Learning", plot_script(plot, "autoencoder-learning"), 2}};
}

struct ClassLabel {
  std::size_t digit;
  double x, y;  // in the drawing
};

// Those that would cover each other are moved apart until each can be read.
void spread(std::vector<ClassLabel>& labels) {
  constexpr double kApart = 19;
  for (int round = 0; round < 50; ++round)
    for (std::size_t i = 0; i < labels.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) {
        const double dx = labels[i].x - labels[k].x, dy = labels[i].y - labels[k].y, d = std::hypot(dx, dy);
        if (d >= kApart) continue;
        const double push = (kApart - d) / 2, ux = d > 0 ? dx / d : 1, uy = d > 0 ? dy / d : 0;
        labels[i].x += push * ux, labels[i].y += push * uy;
        labels[k].x -= push * ux, labels[k].y -= push * uy;
      }
}

Panel latent_panel(const Hdf5Reader& file, Tables& tables) {
  constexpr int kPixels = 800;
  constexpr double kSide = kPlotHeight;
  const auto latent = file.read<float>("latent/position");
  const auto label = file.read<std::uint8_t>("latent/label").values;
  if (latent.shape.size() != 2 || latent.values.empty() || latent.shape[0] != label.size())
    throw InputError("{}: latent/position does not hold a position per label", file.path().string());
  const std::size_t dim = latent.shape[1];
  cv::Mat dots(kPixels, kPixels, CV_8UC4, cv::Scalar(0, 0, 0, 0));
  std::array<std::vector<double>, 10> xs, ys;
  for (std::size_t i = 0; i < label.size(); ++i) {
    const std::size_t digit = std::min<std::size_t>(label[i], 9);
    const double x = latent.values[dim * i], y = dim > 1 ? latent.values[dim * i + 1] : 0;
    xs[digit].push_back(x);
    ys[digit].push_back(y);
    const std::uint32_t c = kClassColours[digit];
    cv::circle(dots, {cvRound((x + 1) / 2 * (kPixels - 1)), cvRound((1 - y) / 2 * (kPixels - 1))}, 3,
               cv::Scalar(c & 255, c >> 8 & 255, c >> 16, 200), cv::FILLED, cv::LINE_8);
  }
  const double width = 400, left = (width - kSide) / 2, kEdge = 22;
  std::string body = svg_image(encode_png(dots), left, 0, kSide, kSide, "photo");
  std::vector<ClassLabel> labels;
  for (std::size_t digit = 0; digit < 10; ++digit) {
    if (xs[digit].empty()) continue;
    const double x = summarise(xs[digit], "latent x").median, y = summarise(ys[digit], "latent y").median;
    tables["classes"].add({{"class", static_cast<double>(digit)}, {"median_x", x}, {"median_y", y}});
    labels.push_back({digit, left + (x + 1) / 2 * kSide, (1 - y) / 2 * kSide});
  }
  spread(labels);
  for (const ClassLabel& at : labels)
    body += fmt::format(
        "<circle cx=\"{0:.1f}\" cy=\"{1:.1f}\" r=\"9\" fill=\"#ffffff\" fill-opacity=\"0.9\"/><text "
        "x=\"{0:.1f}\" "
        "y=\"{2:.1f}\" font-family=\"sans-serif\" font-size=\"13\" font-weight=\"bold\" "
        "text-anchor=\"middle\" "
        "fill=\"#111111\">{3}</text>\n",
        at.x, at.y, at.y + 4.7, at.digit);
  return {
      dim > 2 ? "Test images in the first two latent dimensions" : "Test images in the latent space",
      Drawing{width, kSide + kEdge, body + square_axes(left, 0, kSide),
              fmt::format(
                  "A dot for each of {} test images at its latent place, coloured by class; the number of "
                  "each class stands at its median.",
                  label.size())},
      2};
}

std::vector<Panel> kept_panel(const StatisticsView& statistics, Tables& tables) {
  BarPlot plot{
      .unit = "% of the class", .x_label = "class", .groups = {}, .series = {{"", Colour::blue, {}}}};
  for (int digit = 0; digit < 10; ++digit) {
    const auto kept = statistics.quantity(fmt::format("autoencoder.kept_of_class.{}", digit));
    if (kept.empty()) return {};
    plot.groups.push_back(std::to_string(digit));
    plot.series[0].values.push_back(100 * summarise(kept, "kept_of_class").median);
    tables["kept"].add({{"class", static_cast<double>(digit)}, {"percent", plot.series[0].values.back()}});
  }
  return {{"Training images kept by the cut", plot_script(plot, "autoencoder-kept"), 2}};
}

Panel reconstruction_panel(const Hdf5Reader& file) {
  constexpr int kPixels = 56;
  constexpr double kWidth = 1232, kEdge = 84;
  const auto original = file.read<std::uint8_t>("reconstruction/original");
  const auto decoded = file.read<float>("reconstruction/decoded").values;
  if (original.shape.size() != 3 || original.values.size() != original.shape[0] * 784 ||
      decoded.size() != original.values.size())
    throw InputError("{}: reconstruction/original and /decoded are not n x 28 x 28", file.path().string());
  const std::size_t n = original.shape[0];
  const double cell = (kWidth - kEdge) / static_cast<double>(n);
  InkSheet sheet(static_cast<int>(n) * kPixels, 2 * kPixels);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<std::uint8_t> image(784);
    for (std::size_t k = 0; k < 784; ++k)
      image[k] = static_cast<std::uint8_t>(std::lround(std::clamp(decoded[i * 784 + k], 0.0f, 1.0f) * 255));
    const double x = (static_cast<double>(i) + 0.5) * kPixels;
    sheet.place({original.values.data() + i * 784, 784}, x, 0.5 * kPixels, kPixels);
    sheet.place(image, x, 1.5 * kPixels, kPixels);
  }
  std::string body = sheet.svg_image(kEdge, 0, kWidth - kEdge, 2 * cell);
  body += svg_text("written", 0, 0.5 * cell + 5, 16, Colour::grey, Align::left);
  body += svg_text("decoded", 0, 1.5 * cell + 5, 16, Colour::grey, Align::left);
  return {"Test images and what the network makes of them",
          Drawing{kWidth, 2 * cell, body,
                  fmt::format(
                      "{} test images, and below each what the network decodes from its latent place.", n)},
          6};
}

}  // namespace

Figure autoencoder_figure(const Evidence& evidence) {
  Figure figure{.id = "autoencoder", .title = "The learned descriptor (the paper’s Fig. 2, bottom)"};
  figure.caption =
      "a: median and quartiles of the squared error over the replications. b: test images of the first "
      "replication at their latent places; each digit stands at the median of its class. c: the share of "
      "each "
      "class that the cut of the training set keeps. d: twenty test images, written and decoded.";
  auto files = evidence.artifacts.replications("autoencoder");
  if (const std::string other = "descriptor.h5"; files.empty() && evidence.artifacts.has(other)) {
    files.push_back(evidence.artifacts.path(other));
    figure.title = "The descriptor in place of the paper’s autoencoder";
    figure.caption =
        "a: test images at their places; each digit stands at the median of its class. b: twenty of them, "
        "written and decoded.";
  }
  if (files.empty()) {
    figure.absent = "This run trained no autoencoder.";
    return figure;
  }
  const Hdf5Reader first(files[0]);
  figure.panels = learning_panel(evidence.statistics, figure.tables);
  figure.panels.push_back(latent_panel(first, figure.tables));
  for (Panel& panel : kept_panel(evidence.statistics, figure.tables))
    figure.panels.push_back(std::move(panel));
  figure.panels.push_back(reconstruction_panel(first));
  return figure;
}

}  // namespace hbr::inline reports
