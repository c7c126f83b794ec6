// Pictures of a scene without a display: a z-buffer, two lights, shadows, one translucent layer.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>
#include <vector>

#include "models/simbody/mesh_file.h"

namespace hbr {

struct Scene {
  std::vector<Posed> bodies;  // what is seen through is convex and casts no shadow
  double floor = 0;           // z of the ground, m
};

struct Camera {
  Eigen::Vector3d eye, target;  // m; z is up in the picture
  double view_rad;              // angle over the picture's height
};

// 8-bit, blue-green-red, as OpenCV has it. Same scene, same bytes.
cv::Mat3b render(const Scene& scene, const Camera& camera, int width, int height);

// A camera that looks along `direction` at everything in the scene, which fills the picture but for a margin.
Camera camera_for(const Scene& scene, const Eigen::Vector3d& direction, double view_rad, double aspect);

// Throws InputError where the file can't be written.
void write_png(const std::filesystem::path& path, const cv::Mat3b& picture);

}  // namespace hbr
