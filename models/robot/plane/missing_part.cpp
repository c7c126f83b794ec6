#include "models/robot/plane/missing_part.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

constexpr std::array<const char*, 9> kRegions = {"the lower left", "the bottom", "the lower right",
                                                 "the left",       "the middle", "the right",
                                                 "the upper left", "the top",    "the upper right"};

constexpr std::size_t kNamed = 3;

struct AreaPart {
  const char* region;
  int points = 0;
  double farthest = 0;  // m
};

// 12345 -> "12 345"
std::string thousands(std::size_t n) {
  return n < 1000 ? std::to_string(n) : fmt::format("{} {:03}", thousands(n / 1000), n % 1000);
}

}  // namespace

std::string missing_part(const std::vector<Eigen::Vector2d>& points, const std::vector<double>& distances,
                         double tolerance) {
  HBR_CHECK(points.size() == distances.size(), "points {}, distances {}", points.size(), distances.size());
  Eigen::AlignedBox2d area;
  for (const Eigen::Vector2d& p : points) area.extend(p);
  std::array<AreaPart, 9> parts;
  for (std::size_t i = 0; i < parts.size(); ++i) parts[i].region = kRegions[i];
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (distances[i] <= tolerance) continue;
    const auto third = [&](int axis) {
      const double size = std::max(area.sizes()[axis], 1e-300);
      return std::clamp(static_cast<int>(3 * (points[i][axis] - area.min()[axis]) / size), 0, 2);
    };
    AreaPart& part = parts[3 * third(1) + third(0)];
    ++part.points;
    part.farthest = std::max(part.farthest, distances[i]);
  }
  std::ranges::stable_sort(parts, std::greater(), &AreaPart::points);
  std::string words;
  int elsewhere = 0;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const AreaPart& part = parts[i];
    if (i >= kNamed) elsewhere += part.points;
    if (i >= kNamed || part.points == 0) continue;
    const double mm = 1000 * part.farthest;
    words += fmt::format("{}{}: {} of {} points, up to {} mm away", words.empty() ? "" : "; ", part.region,
                         thousands(part.points), thousands(points.size()),
                         mm < 10 ? fmt::format("{:.2g}", mm) : thousands(std::lround(mm)));
  }
  if (elsewhere > 0) words += fmt::format("; elsewhere: {}", thousands(elsewhere));
  return words;
}

}  // namespace hbr::inline robots
