// What stages of robots read.
#pragma once

#include "stages/plan/plan.h"

namespace hbr::inline stages {

void append(Inputs& inputs, const Inputs& more);

// The hierarchy that is transferred, the lowest layer first.
std::vector<const LayerRow*> transferred(const Plan& plan);

// The artifacts NAME1, NAME2, ... of a stack over whose points, in which replication: the robot's, or with
// none the arm's own.
Inputs over(const Plan& plan, const std::string& name, const std::vector<const LayerRow*>& stack,
            const RobotSettings* robot, int replication);
Inputs plane(const RobotSettings* robot);

// What a robot looks like: the artifact of its meshes, where a stage makes them (which is added to the plan);
// and the files, its URDF and the meshes that it names. Of a URDF that can't be read only itself: the stages
// that need it say why, and the rest of the experiment goes on.
Inputs meshes_of(Plan& plan, const RobotSettings& robot);
std::vector<std::string> looks_of(const RobotSettings& robot);

}  // namespace hbr::inline stages
