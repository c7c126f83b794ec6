// The paper's drawing area and longest line.
#pragma once

#include "pipeline/hierarchy/frame.h"

namespace hbr {

inline constexpr Frame kFrame{0.63965, 0.256};

}  // namespace hbr
