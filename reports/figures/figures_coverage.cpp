// How other robots cover the arm's area, point by point: their reach, and their layer 1 before and after it
// is moved onto the plane.
#include <fmt/format.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "reports/figures/contender.h"
#include "reports/figures/figures.h"
#include "reports/plot/picture.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr {
namespace {

const std::string kProjected = "_projected";

// One dot for each point [n x 2], drawn over the points' own range: blue, the paler the nearer, up to
// `limit`, vermilion beyond.
Drawing point_map(const std::vector<float>& points, const std::vector<float>& distances, double limit) {
  constexpr int kPixels = 720;
  constexpr double kWidth = 300, kEdge = 12;
  float low = 1e9f, high = -1e9f;
  for (const float v : points) low = std::min(low, v), high = std::max(high, v);
  const double scale = (kPixels - 2 * kEdge) / std::max(static_cast<double>(high - low), 1e-9);
  cv::Mat sheet(kPixels, kPixels, CV_8UC4, cv::Scalar(0, 0, 0, 0));
  const auto dot = [&](std::size_t i, const cv::Scalar& colour) {
    const cv::Point2d at(kEdge + scale * static_cast<double>(points[2 * i] - low),
                         kPixels - kEdge - scale * static_cast<double>(points[2 * i + 1] - low));
    cv::circle(sheet, at, 4, colour, cv::FILLED);
  };
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double share = std::clamp(static_cast<double>(distances[i]) / limit, 0., 1.);
    dot(i, {178 + 50 * (1 - share), 114 + 90 * (1 - share), 150 * (1 - share), 255});
  }
  for (std::size_t i = 0; i < distances.size(); ++i)  // above the others
    if (static_cast<double>(distances[i]) > limit) dot(i, {0, 94, 213, 255});
  return {kWidth, kWidth, svg_image(encode_png(sheet), 0, 0, kWidth, kWidth, "photo")};
}

void add_map(Figure& figure, const std::filesystem::path& path, const std::string& robot,
             const std::string& what, const char* points_name, const std::string& distances_name,
             double limit) {
  const Hdf5Reader file(path);
  const std::vector<float> points = file.read<float>(points_name).values,
                           distances = file.read<float>(distances_name).values;
  if (points.size() != 2 * distances.size() || distances.empty())
    throw InputError("{}: {} and {} do not hold equally many points", path.string(), points_name,
                     distances_name);
  const std::string title = robot_title(robot) + ": " + what;
  figure.panels.push_back({title, point_map(points, distances, limit), 2});
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const std::string series = std::to_string(i);
    figure.table.add(title, series, points[2 * i], "y", points[2 * i + 1]);
    figure.table.add(title, series, points[2 * i], "distance", distances[i]);
  }
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

Figure coverage_figure(const Evidence& evidence) {
  Figure figure{.id = "coverage", .title = "The arm’s points within other robots’ reach."};
  const auto stages = evidence.artifacts.stages("", kProjected);
  if (stages.empty()) {
    figure.absent = "This run has no other robot that draws.";
    return figure;
  }
  std::string missing, shares;
  for (const std::string& stage : stages) {
    const std::string robot = stage.substr(0, stage.size() - kProjected.size());
    if (const std::string plane = robot + "_plane.h5"; evidence.artifacts.has(plane)) {
      const std::filesystem::path path = evidence.artifacts.path(plane);
      const Hdf5Reader file(path);
      add_map(figure, path, robot, "its reach", "points", "distance",
              file.number_attribute("settings.robot.off_plane_tolerance"));
      if (const std::string part = file.text_attribute("missing"); !part.empty())
        missing += fmt::format(" {} misses {}.", escape_html(robot_title(robot)), escape_html(part));
    }
    const std::filesystem::path path = evidence.artifacts.replications(stage).front();
    const double spacing = Hdf5Reader(path).number_attribute("settings.spacing");
    add_map(figure, path, robot, "layer 1 as evolved", "arm_points", "before/nearest", spacing);
    add_map(figure, path, robot, "moved onto its plane", "arm_points", "after/nearest", spacing);
    shares += shares_within(evidence.statistics, robot);
  }
  figure.caption =
      "One dot for each point of the arm’s layer 1 (first replication). Left: the distance at which the "
      "robot’s "
      "tip can come to it on the drawing plane that was found, against the tolerance. Middle and right: the "
      "distance to the robot’s nearest elite, against l. The paler the blue, the nearer; orange-red: "
      "beyond. Of the arm’s points, medians of the replications:" +
      shares + missing;
  return figure;
}

}  // namespace hbr
