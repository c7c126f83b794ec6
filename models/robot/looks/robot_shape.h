// A robot as a viewer needs it that knows neither its URDF nor its meshes' files: rigid parts, the joints
// between them, and surfaces of one colour each.
#pragma once

#include "models/robot/body/body.h"
#include "models/robot/looks/simplify.h"

namespace hbr::inline robots {

struct RobotShape {
  struct Piece {
    int part;   // of `parts`
    Mesh mesh;  // in the part's frame
  };
  std::vector<MovingPart> parts;
  std::vector<Piece> pieces;  // by part; one for each of its colours
  double deviation;           // m, see simplify.h
};

// From the meshes of each link, with at most so many triangles in all, and no more exact than `enough` [m].
RobotShape shape_of(const Body& body, const std::vector<std::vector<Mesh>>& meshes, std::size_t triangles,
                    double enough, Workers& workers);

}  // namespace hbr::inline robots
