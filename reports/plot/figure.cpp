#include "reports/plot/figure.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "pipeline/artifact/content.h"
#include "pipeline/core/check.h"
#include "reports/plot/external.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

constexpr double kPage = 1232, kGap = 16;  // of a figure in its file

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string safe = "\"";
  for (const char c : text) safe += c == '"' ? "\"\"" : std::string(1, c);
  return safe + '"';
}

// "a" of the first of several panels.
std::string letter_of(const Figure& figure, std::size_t panel) {
  return figure.panels.size() < 2 ? "" : std::string(1, static_cast<char>('a' + panel));
}

}  // namespace

void Table::add(const Row& row) {
  const bool first = columns_.empty();
  std::string line;
  for (std::size_t i = 0; i < row.size(); ++i) {
    const auto& [column, value] = row[i];
    if (first) columns_.push_back(column);
    HBR_CHECK(i < columns_.size() && column == columns_[i],
              "a table's row has '{}' where the first had other columns", column);
    if (i > 0) line += ',';
    line += std::holds_alternative<double>(value) ? fmt::format("{}", std::get<double>(value))
                                                  : quoted(std::get<std::string>(value));
  }
  HBR_CHECK(row.size() == columns_.size(), "a table's row has {} of {} columns", row.size(), columns_.size());
  rows_ += line + "\n";
}

std::string Table::csv() const { return fmt::format("{}\n{}", fmt::join(columns_, ","), rows_); }

void add_band(Tables& tables, const std::string& panel, const std::string& x, const Band& band) {
  for (std::size_t i = 0; i < band.x.size(); ++i)
    tables["curves"].add({{"panel", panel},
                          {"series", band.label},
                          {x, band.x[i]},
                          {"q1", band.q1[i]},
                          {"median", band.median[i]},
                          {"q3", band.q3[i]}});
}

void draw_plots(std::vector<Figure>& figures) {
  std::vector<Panel*> panels;
  std::vector<PlotScript> scripts;
  for (Figure& figure : figures)
    for (Panel& panel : figure.panels)
      if (const auto* script = std::get_if<PlotScript>(&panel.drawing)) {
        panels.push_back(&panel);
        scripts.push_back(*script);
      }
  std::vector<Drawing> drawings = draw(scripts);
  for (std::size_t i = 0; i < panels.size(); ++i) panels[i]->drawing = std::move(drawings[i]);
}

std::string figure_html(const Figure& figure) {
  if (!figure.absent.empty())
    return fmt::format("<p class=\"absent\" id=\"figure-{}\">{}</p>\n", figure.id,
                       escape_html(figure.absent));
  std::string html = fmt::format(
      "<figure id=\"figure-{0}\">\n<h4><a href=\"#figure-{0}\">{1}</a></h4>\n"
      "<div class=\"panels\">\n",
      figure.id, escape_html(figure.title));
  for (std::size_t i = 0; i < figure.panels.size(); ++i) {
    const Panel& panel = figure.panels[i];
    const std::string letter = letter_of(figure, i);
    html += fmt::format("<div class=\"panel span{}\"><p>{}{}</p><div class=\"scroll\">{}</div></div>\n",
                        panel.span, letter.empty() ? "" : fmt::format("<b>{}</b> ", letter),
                        escape_html(panel.title),
                        inline_svg(std::get<Drawing>(panel.drawing),
                                   fmt::format("figure-{}-{}", figure.id, i + 1), panel.title));
  }
  std::string files;
  for (const auto& [name, table] : figure.tables)
    files += fmt::format(" <a href=\"figures/{0}_{1}.csv\">{1}.csv</a>", figure.id, name);
  return html + fmt::format(
                    "</div>\n{0}<figcaption>{1} <span class=\"files\"><a href=\"figures/{2}.svg\">svg</a> <a "
                    "href=\"figures/{2}.pdf\">pdf</a>{3}</span></figcaption>\n</figure>\n",
                    figure.notes, figure.caption, figure.id, files);
}

void write_figure(const Figure& figure, const std::filesystem::path& folder) {
  if (!figure.absent.empty()) return;
  std::vector<PlacedDrawing> placed;
  double x = 0, y = 0, row_height = 0;
  int used = 0;
  for (const Panel& panel : figure.panels) {
    if (used + panel.span > 6) {
      x = 0, y += row_height, row_height = 0, used = 0;
    }
    const double shown = (kPage + kGap) / 6 * panel.span - kGap;
    const Drawing& drawing = std::get<Drawing>(panel.drawing);
    const double height = drawing.height * shown / drawing.width;
    const std::string letter = letter_of(figure, placed.size());
    placed.push_back({drawing, letter + (letter.empty() ? "" : "  ") + panel.title, x, y, shown, height});
    x += shown + kGap;
    used += panel.span;
    row_height = std::max(row_height, height + kTitleHeight + kGap);
  }
  const std::string svg = svg_file(placed, kPage, y + row_height - kGap);
  write_file(folder / (figure.id + ".svg"), svg);
  write_file(folder / (figure.id + ".pdf"),
             run_program({"rsvg-convert", "--format=pdf", "--unlimited"}, svg));
  for (const auto& [name, table] : figure.tables)
    write_file(folder / fmt::format("{}_{}.csv", figure.id, name), table.csv());
}

}  // namespace hbr::inline reports
