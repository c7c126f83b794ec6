#include "reports/plot/figure.h"

#include <fmt/format.h>

#include <algorithm>

#include "pipeline/artifact/content.h"
#include "reports/plot/external.h"
#include "reports/text/html.h"

namespace hbr {
namespace {

constexpr double kPage = 1232, kGap = 16;  // of a figure in its file

std::string quoted(const std::string& text) {
  if (text.find_first_of(",\"\n") == std::string::npos) return text;
  std::string safe = "\"";
  for (const char c : text) safe += c == '"' ? "\"\"" : std::string(1, c);
  return safe + '"';
}

}  // namespace

void Table::add(const std::string& panel, const std::string& series, double x, const std::string& quantity,
                double value) {
  rows_ += fmt::format("{},{},{},{},{}\n", quoted(panel), quoted(series), x, quoted(quantity), value);
}

std::string Table::csv() const { return "panel,series,x,quantity,value\n" + rows_; }

void add_band(Table& table, const std::string& panel, const Band& band) {
  for (std::size_t i = 0; i < band.x.size(); ++i) {
    table.add(panel, band.label, band.x[i], "q1", band.q1[i]);
    table.add(panel, band.label, band.x[i], "median", band.median[i]);
    table.add(panel, band.label, band.x[i], "q3", band.q3[i]);
  }
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
  std::string html = fmt::format("<figure id=\"figure-{}\">\n", figure.id);
  if (!figure.absent.empty()) {
    html += fmt::format("<p class=\"absent\">{}</p>\n", escape_html(figure.absent));
  } else {
    html += "<div class=\"panels\">\n";
    for (const Panel& panel : figure.panels)
      html +=
          fmt::format("<div class=\"panel span{}\"><h4>{}</h4>{}</div>\n", panel.span,
                      escape_html(panel.title), inline_svg(std::get<Drawing>(panel.drawing), panel.title));
    html += "</div>\n" + figure.notes;
  }
  html += fmt::format("<figcaption><b>{}</b> {}", escape_html(figure.title), figure.caption);
  if (figure.absent.empty())
    html += fmt::format(
        " <span class=\"files\"><a href=\"figures/{0}.svg\">SVG</a> <a href=\"figures/{0}.pdf\">PDF</a> <a "
        "href=\"figures/{0}.csv\">CSV</a></span>",
        figure.id);
  return html + "</figcaption>\n</figure>\n";
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
    placed.push_back({drawing, panel.title, x, y, shown, height});
    x += shown + kGap;
    used += panel.span;
    row_height = std::max(row_height, height + kTitleHeight + kGap);
  }
  const std::string svg = svg_file(placed, kPage, y + row_height - kGap);
  write_file(folder / (figure.id + ".svg"), svg);
  write_file(folder / (figure.id + ".pdf"),
             run_program({"rsvg-convert", "--format=pdf", "--unlimited"}, svg));
  write_file(folder / (figure.id + ".csv"), figure.table.csv());
}

}  // namespace hbr
