// A figure of the report: panels side by side and the numbers they show.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "reports/plot/plot.h"
#include "reports/plot/svg.h"

namespace hbr {

struct Panel {
  std::string title;
  std::variant<Drawing, PlotScript> drawing;
  int span = 2;  // of the six columns of a row: 2, 3, 4 or 6
};

// The numbers behind a figure, one a row: panel, series, x, quantity, value.
class Table {
 public:
  void add(const std::string& panel, const std::string& series, double x, const std::string& quantity,
           double value);
  // CSV (RFC 4180) with a head line; numbers are written so that they can be read back exactly.
  std::string csv() const;

 private:
  std::string rows_;
};

// A band's three numbers at each x.
void add_band(Table& table, const std::string& panel, const Band& band);

struct Figure {
  std::string id;            // "main_res": name of its files and of its place in the template
  std::string title;         // "The digits"
  std::string caption = {};  // HTML
  std::vector<Panel> panels = {};
  Table table = {};
  std::string notes = {};   // HTML below the panels: a table of tests
  std::string absent = {};  // why it is not there (a sentence); then it has no panels
};

// Draws the plots of all figures at once.
void draw_plots(std::vector<Figure>& figures);

// Of figures whose plots are drawn: <figure>...</figure> for the page: the panels, or the sentence that says
// why there is nothing.
std::string figure_html(const Figure& figure);

// Writes folder/ID.svg, .pdf (by rsvg-convert) and .csv; nothing for an absent figure.
void write_figure(const Figure& figure, const std::filesystem::path& folder);

}  // namespace hbr
