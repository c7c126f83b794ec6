// What the scripts need to draw a robot in three dimensions.
#pragma once

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "reports/page/pack.h"

namespace hbr::inline reports {

// An array of whole numbers from 0 on, in 16 bits where all fit.
template <class T>
void integers(Pack& pack, const std::string& name, const std::vector<std::size_t>& shape,
              const std::vector<T>& values) {
  const bool small = values.empty() || std::ranges::max(values) < 65536;
  if (small)
    pack.array(name, shape, std::vector<std::uint16_t>(values.begin(), values.end()));
  else
    pack.array(name, shape, std::vector<std::int32_t>(values.begin(), values.end()));
}

// "robot-NAME" of the robot's shape (an artifact ROBOT_shape, or one without a board and a pen).
std::string shape_pack(const std::string& robot, const std::filesystem::path& path);

// "three", out of the folder that pipeline/fetch_three.sh fills.
std::string three_pack(const std::filesystem::path& folder);

}  // namespace hbr::inline reports
