// ROBOT_plane.h5, see FORMAT.md.
#pragma once

#include <filesystem>
#include <vector>

#include "models/robot/plane/drawing_plane.h"
#include "pipeline/artifact/hdf5_file.h"

namespace hbr::inline robots {

// The plane, and for each of the arm's points (drawing frame, m) how far from its place on the plane the
// robot stays (metres of the robot); it counts as reached within `tolerance`. Returns the share reached.
double write_plane(Hdf5Writer& file, const DrawingPlane& plane, const std::vector<Eigen::Vector2d>& points,
                   const std::vector<double>& distances, double tolerance);

// Throws InputError where the file does not hold a plane: axes of unit length at right angles, scale above 0.
DrawingPlane load_plane(const std::filesystem::path& path);

}  // namespace hbr::inline robots
