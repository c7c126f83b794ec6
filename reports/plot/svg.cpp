#include "reports/plot/svg.h"

#include <fmt/format.h>

#include <regex>

#include "pipeline/core/check.h"
#include "reports/plot/colour.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

constexpr double kMargin = 12;
constexpr double kLeastScale = 0.85;  // letters of 13 units stay 11 pixels high

std::string replace_all(std::string text, const std::regex& what, const char* by) {
  return std::regex_replace(text, what, by);
}

}  // namespace

Drawing parse_svg(const std::string& text, const std::string& prefix) {
  static const std::regex kViewBox(R"re(viewBox\s*=\s*["']\s*\S+\s+\S+\s+([0-9.]+)\s+([0-9.]+)\s*["'])re");
  std::smatch size;
  const std::size_t tag = text.find("<svg");
  if (tag == std::string::npos || !std::regex_search(text, size, kViewBox))
    throw InputError("the drawing {} is no SVG with a viewBox", prefix);
  const std::size_t begin = text.find('>', tag) + 1, end = text.rfind("</svg>");
  std::string body = text.substr(begin, end - begin);
  static const std::regex kTitle(R"re(<(title|desc)>[^<]*</\1>\s*)re"),
      kEmptyGroup(R"re(<g [^>]*>\s*</g>\s*)re"), kId(R"re(\bid\s*=\s*(["']))re"),
      kHref(R"re(href\s*=\s*(["'])#)re"), kUrl(R"re(url\((["']?)#)re");
  body = replace_all(body, kTitle, "");
  body = replace_all(body, kEmptyGroup, "");
  body = replace_all(body, kId, ("id=$1" + prefix + "-").c_str());
  body = replace_all(body, kHref, ("href=$1#" + prefix + "-").c_str());
  body = replace_all(body, kUrl, ("url($1#" + prefix + "-").c_str());
  return {std::stod(size[1]), std::stod(size[2]), body};
}

std::string inline_svg(const Drawing& drawing, const std::string& id, const std::string& title) {
  HBR_CHECK(!drawing.shows.empty(), "nobody says what the drawing '{}' shows", title);
  const bool letters = drawing.body.find("<text") != std::string::npos;
  return fmt::format(
      "<svg viewBox=\"0 0 {0} {1}\" role=\"img\" aria-labelledby=\"{2}-title {2}-shows\"{3}><title "
      "id=\"{2}-title\">{4}</title><desc id=\"{2}-shows\">{5}</desc>{6}</svg>\n",
      drawing.width, drawing.height, id,
      letters ? fmt::format(" style=\"min-width:{:.0f}px\"", kLeastScale * drawing.width) : "",
      escape_html(title), escape_html(drawing.shows), recolour_for_page(drawing.body));
}

std::string svg_file(const std::vector<PlacedDrawing>& drawings, double width, double height) {
  std::string body;
  for (const auto& [drawing, title, x, y, w, h] : drawings)
    body += fmt::format(
        "<text x=\"{0}\" y=\"{1}\" font-family=\"sans-serif\" font-size=\"14\" font-weight=\"bold\" "
        "fill=\"{2}\">{3}</text>\n<svg x=\"{0}\" y=\"{4}\" width=\"{5}\" height=\"{6}\" viewBox=\"0 0 {7} "
        "{8}\">{9}</svg>\n",
        x, y + 16, hex(Colour::ink), escape_html(title), y + kTitleHeight, w, h, drawing.width,
        drawing.height, drawing.body);
  return recolour_for_paper(
      fmt::format("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" "
                  "xmlns:xlink=\"http://www.w3.org/1999/xlink\" viewBox=\"{0} {0} {1} {2}\" width=\"{1}\" "
                  "height=\"{2}\">\n"
                  "<rect x=\"{0}\" y=\"{0}\" width=\"{1}\" height=\"{2}\" fill=\"white\"/>\n{3}</svg>\n",
                  -kMargin, width + 2 * kMargin, height + 2 * kMargin, body));
}

}  // namespace hbr::inline reports
