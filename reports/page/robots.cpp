#include "reports/page/robots.h"

#include <fmt/format.h>

#include "reports/figures/contender.h"
#include "reports/text/html.h"

namespace hbr::inline reports {

std::vector<Figure> robot_figures(const Evidence& evidence, const std::string& robot) {
  return {posture_figure(evidence, robot), transfer_figure(evidence, robot), coverage_figure(evidence, robot),
          dynamics_figure(evidence, robot), tuned_figure(evidence, robot)};
}

std::string robot_html(const std::string& robot, const std::vector<Figure>& figures) {
  constexpr std::size_t kOpen = 2;
  std::string html = fmt::format("<div class=\"robot\" id=\"robot-{}\">\n<h3>{}</h3>\n", escape_html(robot),
                                 escape_html(robot_title(robot)));
  for (std::size_t i = 0; i < figures.size(); ++i) {
    const std::string figure = figure_html(figures[i]);
    html += i < kOpen || !figures[i].absent.empty()
                ? figure
                : fmt::format("<details class=\"fold\"><summary>{}</summary>\n{}</details>\n",
                              escape_html(figures[i].title), figure);
  }
  return html + "</div>\n";
}

}  // namespace hbr::inline reports
