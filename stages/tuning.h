// What the stages of the fine-tuning (paper, section 5.2, as an outlook) share: for how long a layer goes on
// to evolve, and over whose layer 1.
#pragma once

#include <memory>
#include <vector>

#include "models/simbody/robot_settings.h"
#include "stages/evolve.h"

namespace hbr {

// The robot in the arm's place, on its plane; none: the arm itself, as the control of what more generations
// alone would have gained.
struct Drawer {
  std::vector<RobotSettings> robot;
};
template <class Fields>
void describe_drawer(Fields& f, Drawer& s) {
  f.tables("robot", s.robot, "the robot in the arm's place, one or none");
}
// Reads the input `plane` of a robot.
std::unique_ptr<Robot> make_drawer(const StageRun& stage, const Drawer& drawer, const ArmTable& arm);

// Added to a layer's own slice, whose search counts the generations before with those that are to follow.
struct Continued : Drawer {
  std::int64_t more = 0;
};
template <class Fields>
void describe_continued(Fields& f, Continued& s) {
  describe_drawer(f, s);
  f.number("more", s.more, Range{0, 1e9}, "of the search's generations, those done here");
}

}  // namespace hbr
