// The arm and the robots in three dimensions, drawn by the scripts from packs (pack.h) with three.js.
#pragma once

#include <filesystem>
#include <string>

#include "reports/figures/artifacts.h"

namespace hbr::inline reports {

// For each ROBOT_shape.h5 a pack "robot-NAME", for each ROBOT_ways/RR.h5 "ways-NAME-RR" (joints in whole
// steps of its word `step`); "robots3d", which lists them, NAO first and the arm last; and "three", out of
// that folder. "" where there are no shapes or no folder.
std::string robots_3d_packs(const Artifacts& artifacts, const std::filesystem::path& three);

// What stands in the section: what the scripts fill, or why it is not there.
std::string robots_3d_html(const Artifacts& artifacts, const std::filesystem::path& three);

}  // namespace hbr::inline reports
