// The plan that is handed to make: OUT/.plan/plan.mk, and the slices that its recipes need.
#pragma once

#include <filesystem>
#include <vector>

#include "pipeline/artifact/freshness.h"

namespace hbr::inline artifact {

std::filesystem::path plan_path(const std::filesystem::path& out);

// Plans what is not fresh, in groups of at most so many seconds (group.h) by what its stages needed before on
// so many threads. Returns the number of groups.
std::size_t write_plan(const std::filesystem::path& out, const Graph& graph,
                       const std::vector<Freshness>& freshness, int threads, double group_seconds);

}  // namespace hbr::inline artifact
