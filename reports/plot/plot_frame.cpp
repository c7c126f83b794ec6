#include "reports/plot/plot_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pipeline/core/check.h"
#include "reports/plot/colour.h"
#include "reports/text/format.h"

namespace hbr::inline reports {
namespace {

constexpr double kLeft = 62, kTop = 28;
constexpr std::size_t kFewestTicks = 3;

// Multiples of `step` in [low, high]; the ends may be missed by a rounding.
std::vector<double> multiples(double step, double low, double high) {
  std::vector<double> ticks;
  const double slack = 1e-9 * (high - low);
  for (double k = std::ceil((low - slack) / step); k * step <= high + slack; ++k) ticks.push_back(k * step);
  return ticks;
}

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

std::vector<double> round_ticks(double low, double high) {
  HBR_CHECK(low < high, "an axis from {} to {}", low, high);
  const double power = std::pow(10.0, std::floor(std::log10(high - low)));
  for (const double factor : {5.0, 2.0, 1.0, 0.5, 0.2})
    if (const auto ticks = multiples(factor * power, low, high); ticks.size() >= kFewestTicks) return ticks;
  return multiples(0.1 * power, low, high);
}

std::vector<double> log_ticks(double low, double high) {
  HBR_CHECK(low > 0 && low < high, "a logarithmic axis from {} to {}", low, high);
  const auto ticks_of = [&](std::initializer_list<double> factors) {
    std::vector<double> ticks;
    for (double e = std::floor(std::log10(low)); std::pow(10.0, e) <= high; ++e)
      for (const double factor : factors)
        if (const double tick = factor * std::pow(10.0, e); tick >= low && tick <= high)
          ticks.push_back(tick);
    return ticks;
  };
  for (const auto& ticks : {ticks_of({1}), ticks_of({1, 2, 5})})
    if (ticks.size() >= kFewestTicks) return ticks;
  return round_ticks(low, high);
}

std::vector<std::string> tick_labels(const std::vector<double>& ticks) {
  int digits = 1;
  for (const double tick : ticks) digits = std::max(digits, exact_digits(tick));
  std::vector<std::string> labels;
  const std::string one = "1·";  // of 10⁻⁴
  for (const double tick : ticks) {
    const std::string label = format_number(tick, digits);
    labels.push_back(label.starts_with(one) ? label.substr(one.size()) : label);
  }
  return labels;
}

std::string gnuplot_ticks(const char* axis, const std::vector<double>& ticks) {
  const std::vector<std::string> labels = tick_labels(ticks);
  std::string list;
  for (std::size_t i = 0; i < ticks.size(); ++i) list += (i ? ", " : "") + gnuplot_tick(labels[i], ticks[i]);
  return fmt::format("set {} ({})\n", axis, list);
}

std::string gnuplot_quoted(const std::string& text) {
  std::string safe = "\"";
  for (const char c : text) {
    if (c == '\n')
      safe += "\\n";
    else if (c == '`')
      safe += "\\140";
    else if (c == '"' || c == '\\')
      safe += {'\\', c};
    else
      safe += c;
  }
  return safe + '"';
}

std::string gnuplot_tick(const std::string& label, double at) {
  std::string format;  // gnuplot writes the number where a label has a %
  for (const char c : label) format += std::string(c == '%' ? 2 : 1, c);
  return fmt::format("{} {}", gnuplot_quoted(format), at);
}

std::string plot_head(double width, const std::string& unit, double right_margin, double bottom_margin) {
  const std::string ink = hex(Colour::ink), faint = hex(Colour::faint);
  return fmt::format(
      "set encoding utf8\n"
      "set terminal svg size {0},{1} dynamic noenhanced font 'sans-serif,13'\n"
      "set minussign\n"
      "set lmargin at screen {2}\nset rmargin at screen {3}\n"
      "set tmargin at screen {4}\nset bmargin at screen {5}\n"
      "set border 1 lc rgb '{6}'\n"
      "set grid ytics lt 1 lc rgb '{7}' lw 0.8\n"
      "set xtics nomirror scale 0.4 textcolor rgb '{6}'\n"
      "set ytics nomirror scale 0 textcolor rgb '{6}'\n"
      "unset key\n"
      "set label {8} at screen 0.01, screen {9} left textcolor rgb '{10}'\n",
      width, kPlotHeight, kLeft / width, 1 - right_margin / width, 1 - kTop / kPlotHeight,
      bottom_margin / kPlotHeight, ink, faint, gnuplot_quoted(unit), 1 - 11 / kPlotHeight,
      hex_of_words(Colour::grey));
}

}  // namespace hbr::inline reports
