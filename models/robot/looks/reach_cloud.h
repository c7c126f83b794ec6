// What a robot reaches, as something to look at.
#pragma once

#include "models/robot/body/chain.h"
#include "models/robot/looks/camera.h"

namespace hbr::inline robots {

// Places of the chain's tip in postures at random, as points that are seen through: the more postures come to
// a place, the denser it looks; blue at the chain's first joint, then green, yellow, and red as far away as
// any of them. `extent` is the size of what is looked at, m, which scales the points. In the root link's
// frame.
Posed reach_cloud(const Chain& chain, int postures, double extent);

}  // namespace hbr::inline robots
