// A figure of the report: panels side by side and the numbers they show.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "reports/plot/plot.h"
#include "reports/plot/svg.h"

namespace hbr::inline reports {

struct Panel {
  std::string title;
  std::variant<Drawing, PlotScript> drawing;
  int span = 2;  // of the six columns of a row: 2, 3, 4 or 6
};

// Numbers behind a figure: an observation a row, a variable a column.
class Table {
 public:
  using Value = std::variant<std::string, double>;
  using Row = std::vector<std::pair<std::string, Value>>;  // column, value

  // All rows have the columns of the first.
  void add(const Row& row);
  // CSV (RFC 4180) with a head line; numbers are written so that they can be read back exactly.
  std::string csv() const;

 private:
  std::vector<std::string> columns_;
  std::string rows_;
};
using Tables = std::map<std::string, Table>;  // by their names: "curves", "boxes"

// A band's three numbers at each x, which the column `x` holds, into the table "curves".
void add_band(Tables& tables, const std::string& panel, const std::string& x, const Band& band);

struct Figure {
  std::string id;            // "main_res": name of its files and of its place in the template
  std::string title;         // "The digits"
  std::string caption = {};  // HTML; calls the panels by their letters: a, b, ... where there are several
  std::vector<Panel> panels = {};
  Tables tables = {};
  std::string notes = {};   // HTML below the panels: a table of tests
  std::string absent = {};  // why it is not there (a sentence); then it has no panels
};

// Draws the plots of all figures at once.
void draw_plots(std::vector<Figure>& figures);

// Of figures whose plots are drawn: <figure>...</figure> for the page, its title a heading of the fourth rank
// with an address: the panels, or the sentence that says why there is nothing.
std::string figure_html(const Figure& figure);

// Writes folder/ID.svg, .pdf (by rsvg-convert) and ID_TABLE.csv for each table; nothing for an absent figure.
void write_figure(const Figure& figure, const std::filesystem::path& folder);

}  // namespace hbr::inline reports
