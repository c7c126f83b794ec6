#include "models/robot/plane/plane_file.h"

#include <algorithm>

#include "models/robot/plane/missing_part.h"
#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

constexpr const char* kAxes[3] = {"_x", "_y", "_z"};

}  // namespace

double write_plane(Hdf5Writer& file, const DrawingPlane& plane, const std::vector<Eigen::Vector2d>& points,
                   const std::vector<double>& distances, double tolerance) {
  HBR_CHECK(points.size() == distances.size(), "points {}, distances {}", points.size(), distances.size());
  std::vector<float> positions, gaps;
  std::vector<std::uint8_t> reached;
  for (std::size_t i = 0; i < points.size(); ++i) {
    positions.push_back(static_cast<float>(points[i][0]));
    positions.push_back(static_cast<float>(points[i][1]));
    gaps.push_back(static_cast<float>(distances[i]));
    reached.push_back(distances[i] <= tolerance);
  }
  const double covered = points.empty() ? 0
                                        : static_cast<double>(std::count(reached.begin(), reached.end(), 1)) /
                                              static_cast<double>(points.size());
  for (int k = 0; k < 3; ++k) {
    file.attribute(std::string("origin") + kAxes[k], plane.origin[k]);
    file.attribute(std::string("axis_u") + kAxes[k], plane.u[k]);
    file.attribute(std::string("axis_v") + kAxes[k], plane.v[k]);
  }
  file.attribute("scale", plane.scale);
  file.attribute("covered", covered);
  file.attribute("missing", missing_part(points, distances, tolerance));
  file.write("points", {points.size(), 2}, positions.data());
  file.write("distance", gaps);
  file.write("reached", reached);
  return covered;
}

DrawingPlane load_plane(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  DrawingPlane plane;
  for (int k = 0; k < 3; ++k) {
    plane.origin[k] = file.number_attribute(std::string("origin") + kAxes[k]);
    plane.u[k] = file.number_attribute(std::string("axis_u") + kAxes[k]);
    plane.v[k] = file.number_attribute(std::string("axis_v") + kAxes[k]);
  }
  plane.scale = file.number_attribute("scale");
  if (!plane.origin.allFinite() || !(std::abs(plane.u.norm() - 1) < 1e-9) ||
      !(std::abs(plane.v.norm() - 1) < 1e-9) || !(std::abs(plane.u.dot(plane.v)) < 1e-9))
    throw InputError("{}: axis_u and axis_v are not unit vectors at right angles; build the plane again",
                     path.string());
  if (!(plane.scale > 0) || !std::isfinite(plane.scale))
    throw InputError("{}: scale is {}; expected more than 0", path.string(), plane.scale);
  return plane;
}

}  // namespace hbr::inline robots
