// Boards as something to look at.
#pragma once

#include "models/robot/looks/mesh_file.h"
#include "models/robot/plane/board_collision.h"

namespace hbr::inline robots {

// The square of the board, seen through, in a frame of that colour, in the root link's frame.
Posed framed_board(const std::string& name, const Board& board, const Eigen::Vector3f& colour);

}  // namespace hbr::inline robots
