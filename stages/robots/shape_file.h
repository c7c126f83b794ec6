// A robot's parts, joints and surfaces as arrays of an artifact (pipeline/artifact/FORMAT.md, ROBOT_shape).
#pragma once

#include "models/robot/looks/robot_shape.h"
#include "pipeline/artifact/hdf5_file.h"

namespace hbr::inline stages {

void write_shape(Hdf5Writer& file, const Body& body, const RobotShape& shape);

}  // namespace hbr::inline stages
