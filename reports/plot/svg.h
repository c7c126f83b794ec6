// SVG texts: cleaned, inlined and put side by side.
#pragma once

#include <string>
#include <vector>

namespace hbr::inline reports {

// A drawing of its own coordinates [0, width] x [0, height]; `body` is what stands between <svg> and </svg>.
struct Drawing {
  double width = 0, height = 0;
  std::string body;
  std::string shows = {};  // what it shows, in a sentence for those who cannot see it
};

// A drawing from a whole SVG text (gnuplot's, dot's): its viewBox and its body, every id in it and every
// reference to one prefixed, so that several can stand in one page. Throws InputError without a viewBox.
Drawing parse_svg(const std::string& text, const std::string& prefix);

// For the page: colours as CSS variables, its width that of its place, but no narrower than its letters can
// be read. `title` and what the drawing shows, which must not be empty, are read out to those who cannot see
// it; `id` is unique in the page.
std::string inline_svg(const Drawing& drawing, const std::string& id, const std::string& title);

// A drawing in a file, scaled to width x height: its title's top left corner at (x, y), itself kTitleHeight
// below.
struct PlacedDrawing {
  Drawing drawing;
  std::string title;
  double x = 0, y = 0, width = 0, height = 0;
};
inline constexpr double kTitleHeight = 26;

// A file of its own of that size and a margin, on white.
std::string svg_file(const std::vector<PlacedDrawing>& drawings, double width, double height);

}  // namespace hbr::inline reports
