// Plots by gnuplot: bands over generations, and boxes. All numbers are computed by us; gnuplot only draws.
#pragma once

#include <string>
#include <vector>

#include "pipeline/statistics/summary.h"
#include "reports/plot/colour.h"
#include "reports/plot/svg.h"

namespace hbr::inline reports {

// Median and quartiles of several replications along x; the vectors are equally long, x ascends.
struct Band {
  std::string label;
  Colour colour = Colour::grey;
  std::vector<double> x, q1, median, q3;
};

struct BandPlot {
  std::string x_label = {}, unit = {};  // the unit stands above the axis
  std::vector<Band> bands = {};         // one at least; each carries its label at its right end
  bool from_zero = false;
  double width = 400;
};

struct BoxSeries {
  std::string label = {};  // "\n" breaks it
  Colour colour = Colour::grey;
  Box box;
  std::vector<double> points = {};  // drawn beside the box; for few values
};

// A line above two boxes with a text, for a test between them.
struct Bracket {
  std::size_t left, right;  // boxes
  std::string text = {};
};

struct BoxPlot {
  std::string unit = {};
  std::vector<BoxSeries> boxes = {};  // one at least
  std::vector<Bracket> brackets = {};
  bool logarithmic = false;  // no further down than a tenth of the least quartile above 0
  bool from_zero = false;
  double width = 400;
};

// One bar per group and series, from zero.
struct BarSeries {
  std::string label = {};
  Colour colour = Colour::grey;
  std::vector<double> values = {};  // one per group
};

struct BarPlot {
  std::string unit = {}, x_label = {};
  std::vector<std::string> groups = {};
  std::vector<BarSeries> series = {};  // one at least; more than one carry their labels above the bars
  double width = 400;
};

// What gnuplot is told. `prefix` makes the ids of the drawing unique in a page; `shows` says its numbers in
// words (Drawing).
struct PlotScript {
  std::string text, prefix, shows;
};
PlotScript plot_script(const BandPlot& plot, const std::string& prefix);
PlotScript plot_script(const BoxPlot& plot, const std::string& prefix);
PlotScript plot_script(const BarPlot& plot, const std::string& prefix);

// Their drawings, 280 units high, by one call of gnuplot, which takes longer to start than to draw.
std::vector<Drawing> draw(const std::vector<PlotScript>& scripts);

}  // namespace hbr::inline reports
