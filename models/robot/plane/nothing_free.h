// Why a robot has no configuration in which its tip touches a board.
#pragma once

#include "models/robot/plane/clearance.h"
#include "pipeline/core/check.h"

namespace hbr::inline robots {

// The error of a search that tried so many configurations of the moving joints and found none: whether the
// robot runs into itself, or which link is in a board's way, as some configurations of its own tell, and what
// to do.
InputError nothing_free(const Body& body, const Clearance& clearance, int tip, int tried);

}  // namespace hbr::inline robots
