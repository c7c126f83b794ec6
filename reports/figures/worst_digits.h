// The digits of a robot that differ most from the arm's, and why.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reports/plot/figure.h"

namespace hbr::inline reports {

// Of the artifacts ROBOT_transfer and ROBOT_dynamics (the latter may be none) the worst digits of each form,
// replications together: an HTML table, and the same in the table "worst" of `tables`.
//
// A digit over layer 1 lacks what most of its places lack that lack anything: an elite (a gap), a way that
// passes nothing (collision), or longer joints' ranges (limit); where none lacks anything, elites beside the
// places added up. A replayed one is its postures' fault where the smooth way through them makes more than
// half of the difference by itself, its servos' limits' where they were passed, else the servos'.
std::string worst_digits(const std::vector<std::filesystem::path>& transfers,
                         const std::vector<std::filesystem::path>& replays, Tables& tables);

}  // namespace hbr::inline reports
