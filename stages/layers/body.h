// The body whose joints a layer moves, as slices and artifacts tell of it.
#pragma once

#include <memory>
#include <vector>

#include "models/robot/plane/robot_on_plane.h"
#include "models/robot/plane/robot_settings.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/hierarchy/robot.h"

namespace hbr::inline stages {

struct ArmTable {
  std::vector<double> links;
  double joint_limit = 0;
};
template <class Fields>
void describe(Fields& f, ArmTable& s) {
  f.numbers("links", s.links, Range{1e-3, 10}, "lengths of the links, base first, m; one at least");
  f.number("joint_limit", s.joint_limit, Range{1e-3, 3.2}, "every joint turns in [-limit, limit], rad");
}

// {"arm": ...} or {"robot": ...}. A robot stands on the plane of the stage's input `plane`. `where` leads the
// errors.
std::unique_ptr<Robot> make_body(const nlohmann::json& body, const std::string& where, const StageRun& stage);

// The body as a robot on its plane; throws InputError where it is the arm.
const RobotOnPlane& on_plane(const Robot& body);

}  // namespace hbr::inline stages
