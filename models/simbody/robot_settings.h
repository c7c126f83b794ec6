// What a profile says of a robot: a URDF and this table are all that a new one needs.
#pragma once

#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "models/simbody/drawing_plane.h"
#include "pipeline/artifact/settings.h"
#include "pipeline/core/check.h"

namespace hbr {

struct PlaneSettings {
  std::vector<double> origin;
  double azimuth_deg = 0, elevation_deg = 0, scale = 0;

  DrawingPlane plane() const {
    if (origin.size() != 3) throw InputError("plane.origin: expected 3 numbers, found {}", origin.size());
    const double rad = std::numbers::pi / 180;
    return DrawingPlane::facing({origin[0], origin[1], origin[2]}, azimuth_deg * rad, elevation_deg * rad,
                                scale);
  }
};

template <class Fields>
void describe(Fields& f, PlaneSettings& s) {
  f.numbers("origin", s.origin, Range{-100, 100}, "where the arm's base comes to lie, m, root link's frame");
  f.number("azimuth_deg", s.azimuth_deg, Range{-180, 180}, "where the robot looks: about z, from x");
  f.number("elevation_deg", s.elevation_deg, Range{-89, 89}, "where the robot looks: upwards");
  f.number("scale", s.scale, Range{1e-3, 1e3}, "metres of the robot per metre of the arm");
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
  PlaneSettings plane;

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
  f.table("plane", s.plane, "where the search for the drawing plane begins");
}

}  // namespace hbr
