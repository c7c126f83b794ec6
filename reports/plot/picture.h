// Pixels in the report: drawn digits as ink on nothing, so that the page's paper shows through in light and
// dark, in PNGs inside SVGs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>

#include "reports/plot/colour.h"
#include "reports/plot/svg.h"

namespace hbr::inline reports {

inline constexpr int kImageSide = 28;  // pixels of a drawn digit

// Ink on a transparent sheet.
class InkSheet {
 public:
  InkSheet(int width, int height) : ink_(height, width, CV_8UC1, cv::Scalar(0)) {}

  // A 28 x 28 image (255 is ink), scaled to `side` pixels, its centre at (x, y); what lies outside is cut.
  // Where digits overlap the darker pixel stays.
  void place(std::span<const std::uint8_t> image, double x, double y, int side);
  // As an SVG element that fills a box of the drawing; its class "ink" is inverted on dark pages.
  std::string svg_image(double x, double y, double width, double height) const;

 private:
  cv::Mat ink_;
};

// A PNG file as a drawing of that width. Throws InputError where it is none.
Drawing picture_file(const std::filesystem::path& png, double width);

// <image> with any bytes of a PNG.
std::string svg_image(const std::string& png, double x, double y, double width, double height,
                      const char* css_class);
// BGR, BGRA or grey as a PNG's bytes: the same bytes for the same pixels.
std::string encode_png(const cv::Mat& pixels);

// Axes from -1 to 1 below and to the left of a square, in which the latent space is drawn: 22 units beside
// it.
std::string square_axes(double x, double y, double side);

// A line of text in a drawing.
enum class Align { left, centre, right };
std::string svg_text(const std::string& text, double x, double y, double size, Colour colour, Align align);

}  // namespace hbr::inline reports
