// Panels that several figures are made of: curves of searches, and boxes with tests between them.
#pragma once

#include <string>
#include <vector>

#include "reports/figures/statistics_view.h"
#include "reports/plot/figure.h"

namespace hbr::inline reports {

// "Size", "Best" and "Mean" of searches over generations, in the table "curves"; searches ("layer3.n10") that
// were not made are left out, and so is a panel without any. `unit` is the fitness's.
std::vector<Panel> progress_panels(const StatisticsView& statistics, const std::vector<std::string>& searches,
                                   const std::string& figure, const std::string& unit, Tables& tables);

struct BoxOptions {
  std::string title = {}, unit = {};
  std::string figure = {};  // id of the figure the panel is for
  bool logarithmic = false, from_zero = false;
  double scale = 1;      // shown value = value x scale: 100 for shares in per cent
  bool brackets = true;  // p-values between neighbours
  int span = 2;
};

// One box per quantity (one value per replication, shown as points where there are few), in the tables
// "boxes" and "values"; quantities that were not measured are left out. Nothing where none was.
std::vector<Panel> box_panel(const StatisticsView& statistics, const std::vector<std::string>& names,
                             const BoxOptions& options, Tables& tables);

// The same of values pooled over replications; `brackets` are tests between quantities of the same names.
std::vector<Panel> pooled_box_panel(const StatisticsView& statistics, const std::vector<std::string>& names,
                                    const BoxOptions& options, Tables& tables);

// The tests between every two of the quantities as an HTML table; "" where there is none.
std::string tests_table(const StatisticsView& statistics, const std::vector<std::string>& names);

}  // namespace hbr::inline reports
