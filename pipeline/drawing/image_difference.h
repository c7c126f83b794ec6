// How much two images differ.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace hbr::inline drawing {

struct ImageDifference {
  float absolute, squared;  // means per pixel
};

// Of images [28 x 28] of ink from 0 to 1.
ImageDifference image_difference(const Eigen::VectorXf& a, const Eigen::VectorXf& b);

// Mean absolute difference per pixel of images in steps of 1/255, of ink from 0 to 1.
float image_difference(const std::uint8_t* a, const std::uint8_t* b);

}  // namespace hbr::inline drawing
