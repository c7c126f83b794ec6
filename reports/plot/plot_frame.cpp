#include "reports/plot/plot_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "reports/plot/colour.h"
#include "reports/text/format.h"

namespace hbr {
namespace {

constexpr double kLeft = 46, kTop = 26;

}  // namespace

Axis make_axis(double low, double high, const std::string& unit, bool from_zero) {
  if (from_zero) low = std::min(low, 0.0), high = std::max(high, 0.0);
  if (low == 0 && high == 0) high = 1;  // nothing but zeros
  double span = high - low;
  if (span <= 0) span = std::abs(high) * 0.2;
  if (!from_zero || low < 0) low -= 0.05 * span;
  if (!from_zero || high > 0) high += 0.05 * span;
  Axis axis{low, high, 1, unit};
  const double size = std::max(std::abs(low), std::abs(high));
  const int exponent = static_cast<int>(std::floor(std::log10(size)));
  if (exponent < -1 || exponent > 4) {
    axis.scale = std::pow(10.0, -exponent);
    axis.low *= axis.scale;
    axis.high *= axis.scale;
    axis.unit = unit.empty() ? "× " + power_of_ten(exponent) : power_of_ten(exponent) + " " + unit;
  }
  return axis;
}

std::string gnuplot_quoted(const std::string& text) {
  std::string safe = "\"";
  for (const char c : text) {
    if (c == '\n') {
      safe += "\\n";
      continue;
    }
    if (c == '"' || c == '\\') safe += '\\';
    safe += c;
  }
  return safe + '"';
}

std::string plot_head(double width, const std::string& unit, double right_margin, double bottom_margin) {
  const std::string ink = hex(Colour::ink), faint = hex(Colour::faint);
  return fmt::format(
      "set encoding utf8\n"
      "set terminal svg size {0},{1} dynamic noenhanced font 'sans-serif,12'\n"
      "set minussign\n"
      "set lmargin at screen {2}\nset rmargin at screen {3}\n"
      "set tmargin at screen {4}\nset bmargin at screen {5}\n"
      "set border 1 lc rgb '{6}'\n"
      "set grid ytics lt 1 lc rgb '{7}' lw 0.8\n"
      "set xtics nomirror scale 0.4 textcolor rgb '{6}'\n"
      "set ytics nomirror scale 0 textcolor rgb '{6}'\n"
      "unset key\n"
      "set label {8} at screen 0.01, screen {9} left font ',11' textcolor rgb '{10}'\n",
      width, kPlotHeight, kLeft / width, 1 - right_margin / width, 1 - kTop / kPlotHeight,
      bottom_margin / kPlotHeight, ink, faint, gnuplot_quoted(unit), 1 - 11 / kPlotHeight, hex(Colour::grey));
}

}  // namespace hbr
