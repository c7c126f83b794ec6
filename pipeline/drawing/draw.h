// The drawing: what the pen did, as a 28 x 28 image, white on black, like those the autoencoder learned from.
//
// The ink is every point nearer to the path than half the pen's width (so ends and corners are round), and a
// pixel is the share of it that is ink.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>

namespace hbr::inline drawing {

inline constexpr int kImageSide = 28;  // pixels
inline constexpr int kImagePixels = kImageSide * kImageSide;

// Which part of the plane the image shows. The paper does not say.
enum class Framing {
  // As MNIST was made: the ink's bounding box, its aspect kept, fills 20 x 20 px, and the ink's centre of
  // mass is at the middle of pixel (14, 14), where those of MNIST's own digits are; nearer to the box's
  // centre where the ink would not fit into the image. Paths smaller than a millimetre count as a dot.
  box,
  // The square workspace of the robot fills the image; what is outside is not seen.
  workspace,
};

// "box" or "workspace"; throws InputError for any other word.
Framing framing_named(const std::string& name);

// Draws the polyline through pen_xy [points x 2], row-major, in metres, y up, points >= 1, finite; a single
// point is a dot. The width is in pixels, between 0 and 20, and need not be whole. workspace_half_side_m, L,
// matters to Framing::workspace alone: it shows [-L, L]^2. The image [28 x 28], row-major, top row first,
// holds ink from 0 to 1. Thread-safe.
void draw(const float* pen_xy, Eigen::Index points, double pen_width_px, Framing framing,
          double workspace_half_side_m, float* image);

// The image in steps of 1/255, rounded, as artifacts keep it.
void image_to_bytes(const float* image, std::uint8_t* bytes);

}  // namespace hbr::inline drawing
