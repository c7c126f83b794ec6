// The planar arm as a body in space, which draws on an upright board.
#pragma once

#include <vector>

#include "models/robot/plane/robot_on_plane.h"

namespace hbr::inline robots {

// Its joints as models/arm has them: links [m], base first, each turning within [-limit, limit] rad. The root
// link is the base; its frame's x is the drawing frame's, its z the frame's y. The links lie before the
// board, each nearer to it than the one before.
RobotOnPlane planar_body(const std::vector<double>& links, double limit);

}  // namespace hbr::inline robots
