// The robots beside the arm: one after the other, of which a script shows one at a time.
#pragma once

#include <string>
#include <vector>

#include "reports/figures/figures.h"

namespace hbr::inline reports {

// The figures of a robot, in the order in which they stand in the page.
std::vector<Figure> robot_figures(const Evidence& evidence, const std::string& robot);

// The robot's part of the page from its figures, drawn; those behind the first two are folded.
std::string robot_html(const std::string& robot, const std::vector<Figure>& figures);

}  // namespace hbr::inline reports
