// What a profile says of a robot: a URDF and this table are all that a new one needs.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/core/settings.h"

namespace hbr::inline robots {

// The search for a robot's drawing plane.
struct PlaneSearchSettings {
  std::string board;
  bool below_floor = false;
  int samples = 0;
  int refined = 0;
  int points = 0;
};

template <class Fields>
void describe(Fields& f, PlaneSearchSettings& s) {
  f.choice("board", s.board, {"any", "level", "upright", "leaning"},
           "the kind of board that is sought: its normal within 20 degrees of the vertical (level) or of the "
           "horizontal (upright), or between (leaning)");
  f.flag("below_floor", s.below_floor, "whether the board may reach below what the robot stands on");
  f.number("samples", s.samples, Range{1, 1e8}, "configurations that tell where a robot's tip can be");
  f.number("refined", s.refined, Range{1, 100}, "planes of the search that are refined");
  f.number("points", s.points, Range{20, 1e6},
           "of the arm's, that the plane is fitted to; coverage counts all");
}

struct RobotSettings {
  std::string name, urdf, meshes;
  double mesh_scale = 1;
  std::string tip_link;
  std::string stands_on;
  std::vector<std::string> joints;
  std::vector<std::string> rest_joints;
  std::vector<double> rest_positions;
  double off_plane_tolerance = 0;

  std::map<std::string, double> rest() const {
    if (rest_joints.size() != rest_positions.size())
      throw InputError("robot '{}': {} rest_joints but {} rest_positions; expected as many", name,
                       rest_joints.size(), rest_positions.size());
    std::map<std::string, double> result;
    for (std::size_t i = 0; i < rest_joints.size(); ++i) result[rest_joints[i]] = rest_positions[i];
    return result;
  }
};

template <class Fields>
void describe(Fields& f, RobotSettings& s) {
  f.text("name", s.name, "the robot's name, as files and figures call it");
  f.text("urdf", s.urdf, "its URDF, absolute or below the repository");
  f.text(
      "meshes", s.meshes,
      "folder to look for its meshes, or the stage that makes them (nao_meshes); empty: where the URDF says");
  f.number("mesh_scale", s.mesh_scale, Range{1e-6, 1e6}, "metres per unit of its mesh files");
  f.text("tip_link", s.tip_link, "the link whose origin is the pen");
  f.text("stands_on", s.stands_on,
         "the link that stands still while the whole body moves in the dynamics; empty: the root link");
  f.texts("joints", s.joints, "the joints that draw, in the genome's order");
  f.texts("rest_joints", s.rest_joints, "joints that are held elsewhere than at 0");
  f.numbers("rest_positions", s.rest_positions, Range{-100, 100}, "where they are held, rad or m");
  f.number("off_plane_tolerance", s.off_plane_tolerance, Range{1e-9, 1},
           "how far from the plane the pen still draws, metres of the robot");
}

// Of one of the joints that draw, what it loses between motor and link.
struct GearSettings {
  std::string joint;
  double viscous = 0, coulomb = 0, play = 0;
};
template <class Fields>
void describe(Fields& f, GearSettings& s) {
  f.text("joint", s.joint, "one of those that draw");
  f.number("viscous", s.viscous, Range{0, 1e4},
           "friction that grows with the speed, N m s/rad (N s/m where it slides)");
  f.number("coulomb", s.coulomb, Range{0, 1e4},
           "friction of the same torque at any speed, which holds the joint still, N m (N)");
  f.number("play", s.play, Range{0, 1}, "how far the joint moves while its motor stands, rad (m)");
}

}  // namespace hbr::inline robots
