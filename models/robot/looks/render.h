// Pictures of a scene without a display: a z-buffer, two lights, shadows, one translucent layer.
#pragma once

#include <filesystem>
#include <opencv2/core.hpp>

#include "models/robot/looks/camera.h"

namespace hbr::inline robots {

// 8-bit, blue-green-red, as OpenCV has it. Same scene, same bytes.
cv::Mat3b render(const Scene& scene, const Camera& camera, int width, int height);

// Throws InputError where the file can't be written.
void write_png(const std::filesystem::path& path, const cv::Mat3b& picture);

}  // namespace hbr::inline robots
