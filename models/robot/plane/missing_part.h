// Which part of the arm's area a robot does not reach, in words.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

namespace hbr::inline robots {

// "the lower left: 37 of 5 000 points, up to 12 mm away", the fullest of nine regions first, three at most
// ("elsewhere: 12" for the others); "" where no distance (m) exceeds the tolerance. The regions are the
// thirds of the points' own range in x (left to right as the robot sees it) and y (lower to upper).
std::string missing_part(const std::vector<Eigen::Vector2d>& points, const std::vector<double>& distances,
                         double tolerance);

}  // namespace hbr::inline robots
