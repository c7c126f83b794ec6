// The page's explorer: the elites of each layer on a map, drawn by the scripts from packs (pack.h) in the
// page.
#pragma once

#include <string>

#include "reports/figures/artifacts.h"

namespace hbr::inline reports {

// Of each replication that the run has explorer/RR.h5 of a pack "explorer-RR": its arrays by the names that
// they have there, ids and ways in the smallest type that holds them; its words say of each layer what the
// columns of its genes and descriptors are. And a pack "explorer" that lists the replications and names the
// profile.
// "" without.
std::string explorer_packs(const Artifacts& artifacts, const std::string& profile);

// What stands in the section: the place that the scripts fill, or why there is none.
std::string explorer_html(const Artifacts& artifacts);

}  // namespace hbr::inline reports
