// How another robot covers the arm's area, point by point: its reach, and its layer 1 before and after it is
// moved onto the plane.
#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "reports/figures/contender.h"
#include "reports/figures/figures.h"
#include "reports/plot/picture.h"
#include "reports/plot/plot_frame.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

constexpr double kMillimetres = 1000;
constexpr double kMapSide = 310, kMapLeft = 62, kMapTop = 24, kMapWidth = 400, kMapHeight = 438;

// The arm's points, and how far each is from what is asked about it.
struct PointMap {
  std::string title, whose;       // whose millimetres the distances are
  std::vector<float> points;      // [n x 2], m
  std::vector<double> distances;  // mm
  double limit;                   // mm, up to which a point counts as covered
};

cv::Scalar blue(double share) {
  return {178 + 50 * (1 - share), 114 + 90 * (1 - share), 150 * (1 - share), 255};
}
const cv::Scalar kBeyond{0, 94, 213, 255};

std::string rgb(const cv::Scalar& bgr) {
  return fmt::format("rgb({:.0f},{:.0f},{:.0f})", bgr[2], bgr[1], bgr[0]);
}

// What the colours mean: from 0 to the limit, and beyond.
std::string colour_key(const PointMap& map) {
  constexpr int kSteps = 12;
  constexpr double kBar = 96, kTop = kMapHeight - 34;
  std::string body;
  for (int i = 0; i < kSteps; ++i)
    body +=
        fmt::format("<rect x=\"{:.1f}\" y=\"{}\" width=\"{:.1f}\" height=\"12\" fill=\"{}\"/>\n",
                    kMapLeft + i * kBar / kSteps, kTop, kBar / kSteps + 0.3, rgb(blue((i + 0.5) / kSteps)));
  body += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"12\" height=\"12\" fill=\"{}\"/>\n", kMapLeft + 150,
                      kTop, rgb(kBeyond));
  const std::string limit = format_number(map.limit);
  body += svg_text("0", kMapLeft, kTop + 27, 13, Colour::ink, Align::left);
  body += svg_text(limit, kMapLeft + kBar, kTop + 27, 13, Colour::ink, Align::centre);
  body += svg_text("beyond " + limit, kMapLeft + 168, kTop + 11, 13, Colour::ink, Align::left);
  return body + svg_text("distance, mm of the " + map.whose, kMapLeft + 168, kTop + 27, 13, Colour::ink,
                         Align::left);
}

// One dot for each point on axes in metres: blue, the paler the nearer, up to the limit, then orange-red.
Drawing drawn(const PointMap& map) {
  constexpr int kPixels = 930;
  const auto [low, high] = std::ranges::minmax(map.points);
  const double first = static_cast<double>(low), span = std::max(static_cast<double>(high - low), 1e-9);
  const double margin = 0.03 * span;
  const auto share = [&](double metres) { return (metres - first + margin) / (span + 2 * margin); };
  cv::Mat sheet(kPixels, kPixels, CV_8UC4, cv::Scalar(0, 0, 0, 0));
  std::size_t beyond = 0;
  for (const bool above : {false, true})  // those beyond the limit above the others
    for (std::size_t i = 0; i < map.distances.size(); ++i) {
      if ((map.distances[i] > map.limit) != above) continue;
      beyond += above;
      const cv::Point2d at(kPixels * share(static_cast<double>(map.points[2 * i])),
                           kPixels * (1 - share(static_cast<double>(map.points[2 * i + 1]))));
      cv::circle(sheet, at, 4, above ? kBeyond : blue(map.distances[i] / map.limit), cv::FILLED);
    }
  std::string body = svg_image(encode_png(sheet), kMapLeft, kMapTop, kMapSide, kMapSide, "photo");
  body += fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"{}\"/>\n",
                      kMapLeft, kMapTop, kMapSide, kMapSide, hex(Colour::faint));
  const std::vector<double> ticks = round_ticks(first, first + span);
  const std::vector<std::string> labels = tick_labels(ticks);
  for (std::size_t i = 0; i < ticks.size(); ++i) {
    const double at = kMapSide * share(ticks[i]);
    body += svg_text(labels[i], kMapLeft + at, kMapTop + kMapSide + 17, 13, Colour::ink, Align::centre);
    body += svg_text(labels[i], kMapLeft - 5, kMapTop + kMapSide - at + 4, 13, Colour::ink, Align::right);
  }
  body += svg_text("x, m of the arm", kMapLeft + kMapSide / 2, kMapTop + kMapSide + 36, 13, Colour::ink,
                   Align::centre);
  body += svg_text("y, m", kMapLeft, kMapTop - 9, 13, Colour::ink, Align::left);
  return {kMapWidth, kMapHeight, body + colour_key(map),
          fmt::format("A dot for each of {} points of the arm; {} of them are beyond {} mm.",
                      map.distances.size(), beyond, format_number(map.limit))};
}

void add_map(Figure& figure, const PointMap& map) {
  figure.panels.push_back({map.title, drawn(map), 2});
  for (std::size_t i = 0; i < map.distances.size(); ++i)
    figure.tables["points"].add({{"panel", map.title},
                                 {"point", static_cast<double>(i)},
                                 {"x_m", static_cast<double>(map.points[2 * i])},
                                 {"y_m", static_cast<double>(map.points[2 * i + 1])},
                                 {"distance_mm", map.distances[i]}});
}

// Distances of the file, which are `unit` mm each.
std::vector<double> read_distances(const Hdf5Reader& file, const std::string& name, std::size_t points,
                                   double unit) {
  const std::vector<float> read = file.read<float>(name).values;
  if (read.empty() || points != 2 * read.size())
    throw InputError("{}: {} holds {} distances; expected {}, one for each point", file.path().string(), name,
                     read.size(), points / 2);
  std::vector<double> distances;
  for (const float d : read) distances.push_back(unit * static_cast<double>(d));
  return distances;
}

void add_reach(Figure& figure, const Hdf5Reader& file) {
  const std::vector<float> points = file.read<float>("points").values;
  add_map(figure,
          {"Within reach", "robot", points, read_distances(file, "distance", points.size(), kMillimetres),
           kMillimetres * file.number_attribute("settings.robot.off_plane_tolerance")});
}

// Places and distances of a layer 1 are in the units of its descriptor: [0, 1] is [-L, L].
void add_layer1(Figure& figure, const Hdf5Reader& file) {
  const double half_side = file.number_attribute("settings.layer.half_side"),
               unit = 2 * half_side * kMillimetres;
  std::vector<float> points = file.read<float>("arm_points").values;
  for (float& v : points) v = (2 * v - 1) * static_cast<float>(half_side);
  for (const auto& [name, title] : {std::pair{"before/nearest", "Layer 1 as evolved"},
                                    std::pair{"after/nearest", "Moved onto its plane"}})
    add_map(figure, {title, "arm", points, read_distances(file, name, points.size(), unit),
                     unit * file.number_attribute("settings.spacing")});
}

// " NAO reaches 100 %, has 98.7 % within l as evolved, 100 % moved."
std::string shares_within(const StatisticsView& statistics, const std::string& robot) {
  const auto percent = [](double share) { return format_quantity(100 * share, "%"); };
  std::string text = fmt::format(" {}", escape_html(robot_title(robot)));
  if (const auto covered = statistics.number("plane." + robot + ".covered"))
    text += fmt::format(" reaches {},", percent(*covered));
  const auto before = statistics.quantity("projected." + robot + ".within_before"),
             after = statistics.quantity("projected." + robot + ".within_after");
  if (before.empty() || after.empty()) return "";
  return text + fmt::format(" holds {} within l as evolved and {} when moved.",
                            percent(summarise(before, "within").median),
                            percent(summarise(after, "within").median));
}

}  // namespace

Figure coverage_figure(const Evidence& evidence, const std::string& robot) {
  Figure figure{.id = robot + "_coverage", .title = "The arm’s points within reach"};
  const auto files = evidence.artifacts.replications(robot + "_projected");
  if (files.empty()) {
    figure.absent = "The robot’s layer 1 is not in this run.";
    return figure;
  }
  std::string missing;
  if (const std::string plane = robot + "_plane.h5"; evidence.artifacts.has(plane)) {
    const Hdf5Reader file(evidence.artifacts.path(plane));
    add_reach(figure, file);
    if (const std::string part = file.text_attribute("missing"); !part.empty())
      missing = fmt::format(" {} misses {}.", escape_html(robot_title(robot)), escape_html(part));
  }
  add_layer1(figure, Hdf5Reader(files.front()));
  figure.caption =
      "One dot for each point of the arm’s layer 1 (first replication). Within reach: the distance at which "
      "the "
      "robot’s tip can come to it on the drawing plane that was found, against the tolerance. The others: "
      "the "
      "distance to the robot’s nearest elite, against l. Of the arm’s points, medians of the replications:" +
      shares_within(evidence.statistics, robot) + missing;
  return figure;
}

}  // namespace hbr::inline reports
