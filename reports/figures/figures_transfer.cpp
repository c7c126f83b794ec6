// Layers exchanged: another layer 1, another robot (Fig. transfer).
#include <fmt/format.h>

#include <algorithm>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "reports/figures/contender.h"
#include "reports/figures/figures.h"
#include "reports/figures/panels.h"
#include "reports/figures/worst_digits.h"
#include "reports/plot/picture.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

const std::string kTransferred = "_transfer";

struct Pair {
  std::vector<std::uint8_t> arm, robot;  // 784
  float absolute, squared;
};

std::vector<Pair> read_pairs(const std::vector<std::filesystem::path>& files) {
  std::vector<Pair> pairs;
  for (const auto& path : files) {
    const Hdf5Reader file(path);
    const auto arm = file.read<std::uint8_t>("arm").values, robot = file.read<std::uint8_t>("robot").values;
    const auto absolute = file.read<float>("absolute").values, squared = file.read<float>("squared").values;
    const std::size_t n = absolute.size();
    if (arm.size() != n * 784 || robot.size() != n * 784 || squared.size() != n)
      throw InputError("{}: arm, robot, absolute and squared do not hold equally many digits", path.string());
    for (std::size_t i = 0; i < n; ++i) {
      const auto at = static_cast<std::ptrdiff_t>(i * 784);
      pairs.push_back({{arm.begin() + at, arm.begin() + at + 784},
                       {robot.begin() + at, robot.begin() + at + 784},
                       absolute[i],
                       squared[i]});
    }
  }
  std::ranges::stable_sort(pairs, {}, &Pair::absolute);
  return pairs;
}

constexpr int kColumns = 8, kRows = 2;

// At even ranks from the most to the least alike.
std::vector<Pair> at_even_ranks(const std::vector<Pair>& pairs) {
  const std::size_t n = std::min<std::size_t>(pairs.size(), kColumns * kRows);
  std::vector<Pair> some;
  for (std::size_t k = 0; k < n; ++k) some.push_back(pairs[n == 1 ? 0 : k * (pairs.size() - 1) / (n - 1)]);
  return some;
}

// From the least alike on.
std::vector<Pair> worst(const std::vector<Pair>& pairs) {
  const std::size_t n = std::min<std::size_t>(pairs.size(), kColumns * kRows);
  return {pairs.rbegin(), pairs.rbegin() + static_cast<std::ptrdiff_t>(n)};
}

// The arm's digit above the robot's, their difference below.
Panel pairs_panel(const std::string& title, const std::vector<Pair>& pairs, const std::string& robot) {
  constexpr int kPixels = 84;
  constexpr double kWidth = 500, kEdge = 68, kCell = (kWidth - kEdge) / kColumns, kRow = 2 * kCell + 24;
  std::string body;
  for (int row = 0; row < kRows && static_cast<std::size_t>(row * kColumns) < pairs.size(); ++row) {
    InkSheet sheet(kColumns * kPixels, 2 * kPixels);
    const double top = row * kRow;
    for (int column = 0; column < kColumns; ++column) {
      const auto k = static_cast<std::size_t>(row * kColumns + column);
      if (k >= pairs.size()) break;
      const Pair& pair = pairs[k];
      sheet.place(pair.arm, (column + 0.5) * kPixels, 0.5 * kPixels, kPixels);
      sheet.place(pair.robot, (column + 0.5) * kPixels, 1.5 * kPixels, kPixels);
      body += svg_text(format_quantity(100.0 * pair.absolute, "%"), kEdge + (column + 0.5) * kCell,
                       top + 2 * kCell + 13, 13, Colour::grey, Align::centre);
    }
    body += sheet.svg_image(kEdge, top, kColumns * kCell, 2 * kCell);
    body += svg_text("arm", 0, top + 0.5 * kCell + 4, 13, Colour::blue, Align::left);
    body += svg_text(robot, 0, top + 1.5 * kCell + 4, 13, Colour::vermilion, Align::left);
  }
  return {title,
          Drawing{kWidth, kRows * kRow, body,
                  fmt::format("{} pairs of images, the arm’s above the robot’s, and how much they differ.",
                              pairs.size())},
          3};
}

// What a digit's image shows decides how much of it can differ.
std::string framing_words(const std::filesystem::path& path) {
  const std::string framing = Hdf5Reader(path).text_attribute("framing");
  if (framing == "box") return "With the digit’s own box filling the image";
  if (framing == "workspace") return "With the whole drawing area in the image";
  throw InputError("{}: attribute framing is '{}', expected box or workspace", path.string(), framing);
}

// " NAO 2.14 % [0.28; 5.60] (13 % outliers above);"
std::string measured_difference(const StatisticsView& statistics, const std::string& name,
                                const std::string& robot) {
  const auto box = statistics.box(name);
  if (!box) return "";
  return fmt::format(" {} {:.2f} % [{:.2f}; {:.2f}] ({:.1f} % of {} images beyond);", escape_html(robot),
                     box->all.median, box->low, box->high,
                     100 * static_cast<double>(box->above) / static_cast<double>(box->all.n), box->all.n);
}

}  // namespace

Figure substitution_figure(const Evidence& evidence) {
  Figure figure{.id = "substitution", .title = "Another layer 1 under the same arcs (the paper’s Fig. 4a)"};
  figure.caption =
      "Every arc of layer 3 executed over the original layer 1 and over one evolved to use two joints. "
      "M<sub>1</sub>: regularity of the arc, M<sub>2</sub>: the original layer’s fitness, M<sub>3</sub>: the "
      "new "
      "one’s; larger is better. All elites of all replications; whiskers: within 1.5 interquartile ranges; "
      "p: "
      "rank-sum test of the replications’ medians.";
  static constexpr struct {
    const char *metric, *title, *unit;
  } kMetrics[] = {{"m1", "M₁: quality of the arcs", "fitness, no unit"},
                  {"m2", "M₂: joints alike", "fitness, rad²"},
                  {"m3", "M₃: two joints move", "fitness, rad²"}};
  for (const auto& [metric, title, unit] : kMetrics) {
    const std::string name = std::string("substitution.") + metric;
    for (Panel& panel : pooled_box_panel(evidence.statistics, {name + ".original", name + ".substitute"},
                                         {.title = title, .unit = unit, .figure = figure.id}, figure.tables))
      figure.panels.push_back(std::move(panel));
  }
  if (figure.panels.empty()) figure.absent = "This run did not exchange layer 1.";
  return figure;
}

Figure transfer_figure(const Evidence& evidence, const std::string& id) {
  Figure figure{.id = id + kTransferred, .title = "The arm’s digits by this robot (the paper’s Fig. 4b)"};
  const auto files = evidence.artifacts.replications(id + kTransferred);
  if (files.empty()) {
    figure.absent = "The robot does not draw the arm’s digits in this run.";
    return figure;
  }
  const std::string robot = robot_title(id), name = "transfer." + id + ".";
  const std::vector<Pair> pairs = read_pairs(files);
  if (pairs.empty()) throw InputError("{} holds no digit", id + kTransferred);
  const auto boxes = [&](const std::vector<std::string>& measures, const BoxOptions& options) {
    std::vector<std::string> quantities;
    for (const std::string& measure : measures) quantities.push_back(name + measure);
    for (Panel& panel : pooled_box_panel(evidence.statistics, quantities, options, figure.tables))
      figure.panels.push_back(std::move(panel));
  };
  figure.panels.push_back(pairs_panel("From the most to the least alike", at_even_ranks(pairs), robot));
  figure.panels.push_back(pairs_panel("The least alike", worst(pairs), robot));
  boxes({"absolute", "evolved_absolute", "squared", "evolved_squared"},
        {.title = "Difference per pixel, arm against robot",
         .unit = "% of white against black",
         .figure = figure.id,
         .from_zero = true,
         .brackets = false,
         .span = 3});
  boxes({"line_end", "line_displacement", "arc_end", "arc_centre", "arc_length"},
        {.title = "Lines and arcs, arm against robot",
         .unit = "mm of the arm",
         .figure = figure.id,
         .from_zero = true,
         .scale = 1000,
         .brackets = false,
         .span = 3});
  figure.caption = fmt::format(
      "Layers 2 to 4 of the arm over the robot’s layer 1. Digits at even ranks of the mean absolute "
      "difference "
      "per pixel, which stands below each pair (a), and those with the greatest (b); that difference, "
      "absolute "
      "and squared, over all digits of all replications, by the robot’s layer 1 moved onto its plane and "
      "completed, and as it was evolved. Lines and arcs, executed by both from common starts: the distance "
      "between their end points, between what a line displaces the pen by, between the centres of an arc, "
      "and "
      "the difference of its lengths. Whiskers: within 1.5 interquartile ranges. {}, the absolute difference "
      "is, in the median [least; greatest without outliers]:{} the paper, which does not say what its images "
      "show: 0.92 % [0.10; 2.11].",
      framing_words(files.front()), measured_difference(evidence.statistics, name + "absolute", robot));
  figure.notes = worst_digits(files, evidence.artifacts.replications(id + "_dynamics"), figure.tables);
  return figure;
}

Figure posture_figure(const Evidence& evidence, const std::string& robot) {
  const std::string picture = robot + "_picture";
  Figure figure{.id = robot + "_posture", .title = "Drawing a digit"};
  if (!evidence.artifacts.has(picture)) {
    figure.absent = "This run made no picture of the robot.";
    return figure;
  }
  const std::filesystem::path folder = evidence.artifacts.path(picture);
  const auto add = [&](const char* title, const char* file, double width, int span, const char* shows) {
    Drawing drawing = picture_file(folder / file, width);
    drawing.shows = shows;
    figure.panels.push_back({title, std::move(drawing), span});
  };
  add("The posture at the end of the stroke", "posture.png", 400, 2,
      "The robot in front of the board with its digit, which is mirrored because it is seen through the "
      "board.");
  add("Poses along the stroke", "strip.png", 900, 4,
      "The robot from behind its shoulder at several moments, the stroke growing from one to the next.");
  figure.caption = "a: seen through the board, so that the digit is mirrored. b: seen over the shoulder.";
  return figure;
}

}  // namespace hbr::inline reports
