#include "reports/plot/plot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pipeline/core/check.h"
#include "reports/plot/external.h"
#include "reports/plot/plot_frame.h"
#include "reports/text/format.h"

namespace hbr::inline reports {
namespace {

// The first moments of a search are far below all that follows; they may leave the plot.
constexpr double kStart = 0.04;
constexpr double kLabelHeight = 0.078;    // of the plot's height, between labels
constexpr double kBracketHeight = 0.105;  // of the plot's height, for a bracket and its text

// Heights in [0, 1] near the wanted ones but kLabelHeight apart, in the order of `wanted`.
std::vector<double> spread_labels(const std::vector<double>& wanted) {
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return wanted[i]; });
  std::vector<double> height = wanted;
  for (int round = 0; round < 50; ++round)
    for (std::size_t k = 1; k < order.size(); ++k) {
      double &below = height[order[k - 1]], &above = height[order[k]];
      const double missing = kLabelHeight - (above - below);
      if (missing > 0) below -= missing / 2, above += missing / 2;
    }
  return height;
}

std::string data_block(const std::string& name, const std::vector<std::vector<double>>& columns,
                       double scale) {
  std::string text = "$" + name + " << END\n";
  for (std::size_t row = 0; row < columns[0].size(); ++row) {
    text += fmt::format("{}", columns[0][row]);
    for (std::size_t c = 1; c < columns.size(); ++c) text += fmt::format(" {:.9g}", columns[c][row] * scale);
    text += '\n';
  }
  return text + "END\n";
}

// Brackets do not cross where each that overlaps an earlier one stands a level higher.
std::vector<int> bracket_levels(const std::vector<Bracket>& brackets) {
  std::vector<int> levels;
  for (std::size_t i = 0; i < brackets.size(); ++i) {
    int level = 0;
    for (bool free = false; !free;) {
      free = true;
      for (std::size_t k = 0; k < i; ++k)
        if (levels[k] == level && brackets[k].left < brackets[i].right &&
            brackets[i].left < brackets[k].right)
          free = false;
      if (!free) ++level;
    }
    levels.push_back(level);
  }
  return levels;
}

// "HBR 0.535 [0.5; 0.56], flat ... (% of elites)": what is drawn, for those who cannot see it.
std::string one_line(std::string label) {
  std::ranges::replace(label, '\n', ' ');
  return label;
}
std::string listed(const std::vector<std::string>& parts, const std::string& unit) {
  return fmt::format("{}{}.", fmt::join(parts, "; "), unit.empty() ? "" : fmt::format(" ({})", unit));
}

std::string in_words(const BandPlot& plot) {
  std::vector<std::string> parts;
  for (const Band& band : plot.bands)
    parts.push_back(fmt::format("{} goes from {} to {}", one_line(band.label),
                                format_number(band.median.front()),
                                format_quartiles(band.median.back(), band.q1.back(), band.q3.back(), "")));
  return fmt::format("Curves over {}, up to {}. Median [quartiles] of each: {}", plot.x_label,
                     format_number(plot.bands[0].x.back()), listed(parts, plot.unit));
}

std::string in_words(const BoxPlot& plot) {
  std::vector<std::string> parts;
  for (const BoxSeries& series : plot.boxes)
    parts.push_back(
        fmt::format("{} {}", one_line(series.label),
                    format_quartiles(series.box.all.median, series.box.all.q1, series.box.all.q3, "")));
  for (const Bracket& bracket : plot.brackets)
    parts.push_back(fmt::format("{} against {}: {}", one_line(plot.boxes[bracket.left].label),
                                one_line(plot.boxes[bracket.right].label), bracket.text));
  return "Boxes, median [quartiles] of each: " + listed(parts, plot.unit);
}

std::string in_words(const BarPlot& plot) {
  std::vector<std::string> parts;
  for (const BarSeries& series : plot.series) {
    std::vector<std::string> bars;
    for (std::size_t g = 0; g < plot.groups.size(); ++g)
      bars.push_back(fmt::format("{}: {}", plot.groups[g], format_number(series.values[g])));
    parts.push_back((series.label.empty() ? "" : series.label + " ") +
                    fmt::format("{}", fmt::join(bars, ", ")));
  }
  return fmt::format("Bars by {}: {}", plot.x_label, listed(parts, plot.unit));
}

constexpr const char* kSvgHead = "<?xml";  // every drawing begins so

}  // namespace

PlotScript plot_script(const BandPlot& plot, const std::string& prefix) {
  HBR_CHECK(!plot.bands.empty(), "no band in plot {}", prefix);
  double low = INFINITY, high = -INFINITY, last_x = 0;
  for (const Band& band : plot.bands) {
    for (std::size_t i = 0; i < band.x.size(); ++i)
      if (band.x[i] >= kStart * band.x.back()) low = std::min(low, band.q1[i]);
    high = std::max(high, *std::ranges::max_element(band.q3));
    last_x = std::max(last_x, band.x.back());
  }
  const Axis axis = make_axis(low, high, plot.unit, plot.from_zero);
  std::vector<double> ends;
  for (const Band& band : plot.bands)
    ends.push_back((band.median.back() * axis.scale - axis.low) / (axis.high - axis.low));
  ends = spread_labels(ends);

  std::string script = plot_head(plot.width, axis.unit, 96, 48);
  script += fmt::format("set yrange [{}:{}]\nset xrange [0:{}]\n", axis.low, axis.high, last_x);
  script += gnuplot_ticks("ytics", round_ticks(axis.low, axis.high)) +
            gnuplot_ticks("xtics", round_ticks(0, last_x));
  script += fmt::format("set xlabel {} offset 0,0.6 textcolor rgb '{}'\n", gnuplot_quoted(plot.x_label),
                        hex(Colour::ink));
  std::string lines, areas;
  for (std::size_t i = 0; i < plot.bands.size(); ++i) {
    const Band& band = plot.bands[i];
    const std::string colour = hex(band.colour);
    script += data_block(fmt::format("b{}", i), {band.x, band.q1, band.median, band.q3}, axis.scale);
    script += fmt::format("set label {} at graph 1.02, graph {} left textcolor rgb '{}'\n",
                          gnuplot_quoted(band.label), ends[i], hex_of_words(band.colour));
    areas += fmt::format(
        "$b{} using 1:2:4 with filledcurves fc rgb '{}' fs transparent solid 0.18 noborder, ", i, colour);
    lines += fmt::format("$b{} using 1:3 with lines lw 2 lc rgb '{}', ", i, colour);
  }
  lines.resize(lines.size() - 2);
  return {script + "plot " + areas + lines + "\n", prefix, in_words(plot)};
}

PlotScript plot_script(const BoxPlot& plot, const std::string& prefix) {
  HBR_CHECK(!plot.boxes.empty(), "no box in plot {}", prefix);
  // On a logarithmic axis 0 is as far below as this.
  double floor = INFINITY;
  for (const BoxSeries& series : plot.boxes)
    for (const double value : {series.box.all.q1, series.box.all.median, series.box.all.q3})
      if (value > 0) floor = std::min(floor, value / 10);
  const bool logarithmic = plot.logarithmic && floor < INFINITY;
  const auto clipped = [&](double value) { return logarithmic ? std::max(value, floor) : value; };
  const auto shown = [&](double value) { return logarithmic ? std::log10(clipped(value)) : value; };
  double low = INFINITY, high = -INFINITY;
  for (const BoxSeries& series : plot.boxes) {
    low = std::min(low, shown(series.points.empty() ? series.box.low : series.box.all.minimum));
    high = std::max(high, shown(series.points.empty() ? series.box.high : series.box.all.maximum));
  }
  const std::vector<int> levels = bracket_levels(plot.brackets);
  const int top = levels.empty() ? 0 : *std::ranges::max_element(levels) + 1;
  Axis axis = make_axis(low, high, plot.unit, plot.from_zero && !logarithmic);
  if (logarithmic) axis.scale = 1, axis.unit = plot.unit, axis.low = low - 0.15, axis.high = high + 0.15;
  axis.high = axis.low + (axis.high - axis.low) / (1 - kBracketHeight * top);

  std::string script = plot_head(plot.width, axis.unit, 10, 56);
  const double n = static_cast<double>(plot.boxes.size());
  const auto bound = [&](double value) { return logarithmic ? std::pow(10.0, value) : value; };
  if (logarithmic) script += "set logscale y\n";
  script += gnuplot_ticks(
      "ytics", logarithmic ? log_ticks(bound(axis.low), bound(axis.high)) : round_ticks(axis.low, axis.high));
  script += fmt::format("set yrange [{}:{}]\nset xrange [0.4:{}]\nset boxwidth {}\n", bound(axis.low),
                        bound(axis.high), n + 0.6, 0.5);
  std::string ticks, plots;
  for (std::size_t i = 0; i < plot.boxes.size(); ++i) {
    const auto& [label, colour, box, points] = plot.boxes[i];
    const double x = static_cast<double>(i + 1);
    const Summary& s = box.all;
    script += data_block(
        fmt::format("b{}", i),
        {{x}, {clipped(s.q1)}, {clipped(box.low)}, {clipped(box.high)}, {clipped(s.q3)}, {clipped(s.median)}},
        axis.scale);
    ticks += (i ? ", " : "") + gnuplot_tick(label, x);
    plots += fmt::format(
        "$b{0} using 1:2:3:4:5 with candlesticks lw 1.4 lc rgb '{1}' fs transparent solid 0.18 border lc rgb "
        "'{1}' whiskerbars 0.4, $b{0} using 1:6:6:6:6 with candlesticks lw 3 lc rgb '{1}', ",
        i, hex(colour));
    if (points.empty()) continue;
    std::vector<double> places, heights;  // spread by the golden ratio: even, and the same every time
    for (std::size_t k = 0; k < points.size(); ++k) {
      places.push_back(x + 0.3 * (std::fmod(0.618034 * static_cast<double>(k + 1), 1.0) - 0.5));
      heights.push_back(clipped(points[k]));
    }
    script += data_block(fmt::format("p{}", i), {places, heights}, axis.scale);
    plots += fmt::format("$p{} using 1:2 with points pt 7 ps 0.4 lc rgb '{}', ", i, hex(colour));
  }
  for (std::size_t i = 0; i < plot.brackets.size(); ++i) {
    const auto& [left, right, text] = plot.brackets[i];
    const double y = 1 - kBracketHeight * (top - levels[i]) + 0.02;
    script += fmt::format(
        "set arrow from first {0}, graph {2} to first {1}, graph {2} nohead lc rgb '{3}'\n"
        "set label {4} at first {5}, graph {6} center textcolor rgb '{3}'\n",
        static_cast<double>(left) + 1.08, static_cast<double>(right) + 0.92, y, hex(Colour::ink),
        gnuplot_quoted(text), static_cast<double>(left + right) / 2 + 1, y + 0.04);
  }
  plots.resize(plots.size() - 2);
  return {script + "set xtics (" + ticks + ")\nplot " + plots + "\n", prefix, in_words(plot)};
}

PlotScript plot_script(const BarPlot& plot, const std::string& prefix) {
  HBR_CHECK(!plot.series.empty(), "no series in plot {}", prefix);
  double high = 0;
  for (const BarSeries& series : plot.series) high = std::max(high, *std::ranges::max_element(series.values));
  Axis axis = make_axis(0, high, plot.unit, true);
  std::string script = plot_head(plot.width, axis.unit, 10, 48), ticks, plots;
  const double groups = static_cast<double>(plot.groups.size()), n = static_cast<double>(plot.series.size());
  script += fmt::format("set yrange [0:{}]\nset xrange [0.4:{}]\nset boxwidth {}\n", axis.high, groups + 0.6,
                        0.8 / n) +
            gnuplot_ticks("ytics", round_ticks(0, axis.high));
  script += fmt::format("set xlabel {} offset 0,0.6 textcolor rgb '{}'\n", gnuplot_quoted(plot.x_label),
                        hex(Colour::ink));
  for (std::size_t g = 0; g < plot.groups.size(); ++g)
    ticks += (g ? ", " : "") + gnuplot_tick(plot.groups[g], static_cast<double>(g + 1));
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const auto& [label, colour, values] = plot.series[i];
    HBR_CHECK(values.size() == plot.groups.size(), "{} bars, {} groups", values.size(), plot.groups.size());
    std::vector<double> places;
    for (std::size_t g = 0; g < values.size(); ++g)
      places.push_back(static_cast<double>(g + 1) + 0.8 / n * (static_cast<double>(i) - (n - 1) / 2));
    script += data_block(fmt::format("b{}", i), {places, values}, axis.scale);
    plots += fmt::format("{}$b{} using 1:2 with boxes fs solid 0.75 noborder lc rgb '{}'", i ? ", " : "", i,
                         hex(colour));
    if (n > 1)
      script += fmt::format("set label {} at screen {}, screen 0.96 left font ',bold' textcolor rgb '{}'\n",
                            gnuplot_quoted(label), 0.5 + std::min(0.2, 0.48 / n) * static_cast<double>(i),
                            hex_of_words(colour));
  }
  return {script + "set xtics (" + ticks + ")\nplot " + plots + "\n", prefix, in_words(plot)};
}

std::vector<Drawing> draw(const std::vector<PlotScript>& scripts) {
  std::string all;
  for (const PlotScript& script : scripts) all += "reset\n" + script.text;
  const std::string answer = scripts.empty() ? "" : run_program({"gnuplot", "-d", "-"}, all);
  std::vector<Drawing> drawings;
  for (std::size_t begin = answer.find(kSvgHead); begin != std::string::npos;) {
    const std::size_t end = answer.find(kSvgHead, begin + 1);
    if (drawings.size() == scripts.size()) break;
    const PlotScript& script = scripts[drawings.size()];
    drawings.push_back(parse_svg(answer.substr(begin, end - begin), script.prefix));
    drawings.back().shows = script.shows;
    begin = end;
  }
  if (drawings.size() != scripts.size())
    throw InputError("gnuplot made {} drawings of {} scripts", drawings.size(), scripts.size());
  return drawings;
}

}  // namespace hbr::inline reports
