// What the kinds of plot share: the gnuplot script's head, the axis's range and its unit.
#pragma once

#include <string>
#include <vector>

namespace hbr::inline reports {

inline constexpr double kPlotHeight = 280;

// The range of an axis and the power of ten that is taken out of its numbers: 2.7e-4 m² is 2.7 at 10⁻⁴ m².
struct Axis {
  double low = 0, high = 1;  // in shown numbers
  double scale = 1;          // shown number = value x scale
  std::string unit;          // "10⁻⁴ m²"
};

// Holds [low, high] (values) with a little air; a single value gets a range around it.
Axis make_axis(double low, double high, const std::string& unit, bool from_zero);

// Three to seven round numbers (1, 2 or 5 times a power of ten apart) in [low, high], low < high.
std::vector<double> round_ticks(double low, double high);
// The same of an axis that is logarithmic, 0 < low < high: powers of ten, or these times 1, 2 and 5 where
// there are fewer than three, or else as above.
std::vector<double> log_ticks(double low, double high);
// Their numbers with as few digits as all of them are exact with.
std::vector<std::string> tick_labels(const std::vector<double>& ticks);
// "set ytics (...)" or "set xtics (...)".
std::string gnuplot_ticks(const char* axis, const std::vector<double>& ticks);

// A text for gnuplot, quoted: nothing in it is a command, not even between backquotes.
std::string gnuplot_quoted(const std::string& text);
// A label and where it stands on an axis, for "set xtics (...)".
std::string gnuplot_tick(const std::string& label, double at);

// Terminal of that width, margins (right: units left free for labels), border, grid, the unit above the axis.
std::string plot_head(double width, const std::string& unit, double right_margin, double bottom_margin);

}  // namespace hbr::inline reports
