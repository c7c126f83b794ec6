// Layer 5: the numbers that a body writes by commands to layer 4, and the layers of a profile that the paper
// has not.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "reports/figures/contender.h"
#include "reports/figures/figures.h"
#include "reports/figures/panels.h"
#include "reports/plot/picture.h"

namespace hbr::inline reports {
namespace {

constexpr int kNumberColumns = 10;
constexpr double kNumberCell = 64, kNumberGap = 6;

// One number as it stands on the paper.
struct WrittenNumber {
  int value;
  std::vector<std::vector<std::pair<float, float>>> strokes;  // m
};

std::vector<WrittenNumber> read_numbers_shown(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const auto value = file.read<std::int32_t>("shown/value").values;
  const auto points = file.read<std::int32_t>("shown/points");
  const auto pen = file.read<float>("shown/pen").values;
  std::size_t all = 0;
  for (const std::int32_t n : points.values) all += n < 1 ? pen.size() + 1 : static_cast<std::size_t>(n);
  if (points.shape.size() != 2 || points.shape[0] != value.size() || pen.size() != 2 * all)
    throw InputError("{}: shown/value, shown/points and shown/pen do not describe the same numbers",
                     path.string());
  std::vector<WrittenNumber> numbers;
  std::size_t at = 0, stroke = 0;
  for (const std::int32_t v : value) {
    WrittenNumber number{v, {}};
    for (std::size_t k = 0; k < points.shape[1]; ++k, ++stroke) {
      number.strokes.emplace_back();
      for (std::int32_t p = 0; p < points.values[stroke]; ++p, at += 2)
        number.strokes.back().emplace_back(pen[at], pen[at + 1]);
    }
    numbers.push_back(std::move(number));
  }
  return numbers;
}

// The strokes, scaled so that the whole number fills a cell.
std::string number_cell(const WrittenNumber& number) {
  float left = std::numeric_limits<float>::infinity(), right = -left, low = left, high = right;
  for (const auto& stroke : number.strokes)
    for (const auto& [x, y] : stroke) {
      left = std::min(left, x), right = std::max(right, x);
      low = std::min(low, y), high = std::max(high, y);
    }
  const double scale = 0.84 * kNumberCell / static_cast<double>(std::max({right - left, high - low, 1e-6f}));
  std::string body;
  for (const auto& stroke : number.strokes) {
    std::string line;
    for (const auto& [x, y] : stroke)
      line +=
          fmt::format("{:.1f},{:.1f} ", kNumberCell / 2 + scale * static_cast<double>(x - (left + right) / 2),
                      kNumberCell / 2 - scale * static_cast<double>(y - (low + high) / 2));
    body += fmt::format(
        "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"3\" stroke-linejoin=\"round\" "
        "stroke-linecap=\"round\"/>\n",
        line.substr(0, line.size() - 1), hex(Colour::ink));
  }
  return body;
}

// All numbers of as many digits in their order; those that can't be read are left blank, but for their value.
Panel numbers_panel(const std::string& title, const std::filesystem::path& path, Tables& tables) {
  const std::vector<WrittenNumber> numbers = read_numbers_shown(path);
  const bool two = numbers.empty() || numbers.front().strokes.size() == 2;
  std::string body;
  std::size_t next = 0;
  const int cells = two ? 100 : static_cast<int>(numbers.size());
  for (int i = 0; i < cells; ++i) {
    const bool written = two ? next < numbers.size() && numbers[next].value == i : true;
    const double x = (i % kNumberColumns) * (kNumberCell + kNumberGap),
                 y = (i / kNumberColumns) * (kNumberCell + kNumberGap);
    body += fmt::format("<g transform=\"translate({},{})\">\n", x, y);
    if (written) {
      for (std::size_t k = 0; k < numbers[next].strokes.size(); ++k)
        for (std::size_t p = 0; p < numbers[next].strokes[k].size(); ++p)
          tables["strokes"].add({{"panel", title},
                                 {"number", static_cast<double>(numbers[next].value)},
                                 {"digit", static_cast<double>(k + 1)},
                                 {"point", static_cast<double>(p)},
                                 {"x_m", static_cast<double>(numbers[next].strokes[k][p].first)},
                                 {"y_m", static_cast<double>(numbers[next].strokes[k][p].second)}});
      body += number_cell(numbers[next++]);
    } else {
      body += svg_text(fmt::format("{:02}", i), kNumberCell / 2, kNumberCell / 2 + 5, 14, Colour::grey,
                       Align::centre);
    }
    body += "</g>\n";
  }
  const double rows = std::ceil(std::max(cells, 1) / static_cast<double>(kNumberColumns));
  return {title,
          Drawing{kNumberColumns * (kNumberCell + kNumberGap) - kNumberGap,
                  rows * (kNumberCell + kNumberGap) - kNumberGap, body,
                  fmt::format("{} numbers as they were written, in their order.", numbers.size())},
          3};
}

}  // namespace

Figure numbers_figure(const Evidence& evidence) {
  Figure figure{.id = "numbers", .title = "A fifth layer: numbers"};
  figure.caption =
      "A genome of layer 5 commands layer 4 twice, by a place in its latent space and a place on the paper. "
      "For every number of the first replication that the judge can read (both digits good, neither reaching "
      "into the other) the writing is shown whose less certain digit is the most certain; grey: numbers that "
      "were not found. Robots write the arm’s genomes.";
  const auto add = [&](const std::string& stage, const std::string& title) {
    const auto files = evidence.artifacts.replications(stage);
    if (!files.empty()) figure.panels.push_back(numbers_panel(title, files.front(), figure.tables));
  };
  add("numbers", "The arm");
  for (const std::string& stage : evidence.artifacts.stages("", "_numbers"))
    add(stage, robot_title(stage.substr(0, stage.size() - std::string("_numbers").size())));
  if (figure.panels.empty()) {
    figure.absent = "This run has no layer of numbers.";
    return figure;
  }
  std::vector<std::string> values = evidence.statistics.quantities("numbers", ".values");
  for (Panel& panel : box_panel(evidence.statistics, values,
                                {.title = "Different numbers that can be read",
                                .unit = "numbers",
                                .figure = figure.id,
                                .from_zero = true,
                                .brackets = false,
                                .span = 3},
                                figure.tables))
    figure.panels.push_back(std::move(panel));
  return figure;
}

Figure layers_figure(const Evidence& evidence) {
  Figure figure{.id = "layers", .title = "Layers that the paper does not have"};
  figure.caption =
      "Elites (a), best (b) and mean fitness (c) of the profile’s own layers, by their names there: median "
      "and quartiles over the replications.";
  std::vector<std::string> searches;
  for (const std::string& name : evidence.statistics.quantities("layers.", ".size"))
    searches.push_back(name.substr(0, name.size() - std::string(".size").size()));
  figure.panels =
      progress_panels(evidence.statistics, searches, figure.id, "as the layer defines it", figure.tables);
  if (figure.panels.empty()) figure.absent = "This run has no layers but the paper’s.";
  return figure;
}

}  // namespace hbr::inline reports
