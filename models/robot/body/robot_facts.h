// What a description amounts to, for a person who opens a robot for the first time.
#pragma once

#include <string>
#include <vector>

#include "models/robot/description/robot_model.h"

namespace hbr::inline robots {

// One row for each joint: name, type, links, axis, limits, velocity, effort, what it follows.
std::string joint_table(const RobotModel& model);

// What is allowed and seldom meant: joints that can't move or stand at 0, inertias of bodies of another size,
// lengths in another unit. `size` is the whole robot's, m.
std::vector<std::string> oddities(const RobotModel& model, double size);

}  // namespace hbr::inline robots
