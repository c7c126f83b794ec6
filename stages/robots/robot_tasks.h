// What a profile says of the experiments with other robots.
#pragma once

#include <cstdint>
#include <string>

#include "pipeline/core/settings.h"

namespace hbr::inline stages {

struct TransferTable {
  int starts = 0;
};
template <class Fields>
void describe(Fields& f, TransferTable& s) {
  f.number("starts", s.starts, Range{1, 1e4}, "common starts from which each line and arc is executed");
}

// A robot as the page shows it in three dimensions.
struct RobotShapeTable {
  int triangles = 0;
  double deviation = 0;
};
template <class Fields>
void describe(Fields& f, RobotShapeTable& s) {
  f.number("triangles", s.triangles, Range{100, 1e6}, "of each robot, at most");
  f.number("deviation", s.deviation, Range{0, 1},
           "how far its surfaces may be from its meshes, m; more where there are too many triangles");
}

// How long the arm's layers evolve on over another robot, and digits over the arm as well.
struct TuningTable {
  std::int64_t line_generations = 0, arc_generations = 0, digit_generations = 0;
};
template <class Fields>
void describe(Fields& f, TuningTable& s) {
  f.number("line_generations", s.line_generations, Range{1, 1e9}, "for which layer 2 goes on");
  f.number("arc_generations", s.arc_generations, Range{1, 1e9}, "for which layer 3 goes on");
  f.number("digit_generations", s.digit_generations, Range{1, 1e9}, "for which layer 4 goes on");
}

// How the digits are replayed by servos.
struct DynamicsTable {
  int every = 0;
  std::string postures;
  bool within_limits = false;
  double tolerated = 0;
  double pace = 0, joint_pace = 0, smoothing = 0;
  double step = 0;
  int control_every = 0;
  double drawing_hz = 0, holding_hz = 0;
  double lightest = 0;
};
template <class Fields>
void describe(Fields& f, DynamicsTable& s) {
  f.number("every", s.every, Range{1, 1e6}, "of the digits every so many are replayed");
  f.choice("postures", s.postures, {"least_travel", "elites"},
           "how the robot is held along a digit: least_travel, its joints turn as little as they can; "
           "elites, as layer 1 "
           "has each place");
  f.flag("within_limits", s.within_limits,
         "a digit whose servos would pass a limit of torque or speed is drawn more slowly, a tenth below the "
         "limit");
  f.number("tolerated", s.tolerated, Range{0, 1},
           "share of the digits that may leave the board, pass a limit or read otherwise without a word on "
           "the terminal");
  f.number("pace", s.pace, Range{1e-4, 100}, "of the pen, metres of the arm per second");
  f.number("joint_pace", s.joint_pace, Range{1e-3, 100},
           "the joints turn no faster between two way-points on the average, rad/s");
  f.number("smoothing", s.smoothing, Range{1e-3, 10},
           "seconds between the points of the spline that joints follow");
  f.number("step", s.step, Range{1e-5, 0.1}, "of the integration, s");
  f.number("control_every", s.control_every, Range{1, 1e4},
           "steps between two commands to the joints that draw");
  f.number("drawing_hz", s.drawing_hz, Range{0.01, 1000},
           "how fast the joints that draw correct an error, Hz");
  f.number("holding_hz", s.holding_hz, Range{0.01, 1000},
           "how stiff the other joints of the whole body are, Hz");
  f.number("lightest", s.lightest, Range{0, 1e3},
           "joints that move less inertia stay locked in the whole body unless they draw, kg m^2");
}

}  // namespace hbr::inline stages
