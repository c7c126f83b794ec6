// What a board may be, and what it is worth.
#pragma once

#include <limits>
#include <string>
#include <utility>

#include "models/robot/plane/clearance.h"

namespace hbr::inline robots {

// By the angle between a board's normal and the vertical: level up to 20 degrees, upright from 70 on.
enum class BoardKind { any, level, upright, leaning };
BoardKind board_kind(const DrawingPlane& plane);  // never `any`

// The elevations (rad, of the direction in which the robot looks at the board) of the kind that a board of
// this one is, on its side: a range.
std::pair<double, double> elevations_about(double elevation);

BoardKind board_kind_named(const std::string& name);  // InputError for others than the four above

// m, in the root link's frame: the lowest point of the shapes that the joints which draw don't move; of a
// mesh, which is not read here, its link's origin. 0, the root link's, for a robot without any such shape.
double floor_under(const Body& body);

class BoardRules {
 public:
  // Boards of that kind, none of which hangs over (faces down); nothing of their squares lies below `floor`
  // (m). `clearance` must outlive it.
  BoardRules(const Clearance& clearance, BoardKind kind,
             double floor = -std::numeric_limits<double>::infinity())
      : clearance_(clearance), kind_(kind), floor_(floor) {}

  double floor() const { return floor_; }
  bool allows(const Board& board) const;

  // Moved up, where it lies below the floor, onto it.
  Board raised(Board board) const;

  // The board's scale; of boards about as large an upright one is better by 5 % than a level and by 10 % than
  // a leaning one, so that a robot that turns about level axes, to which all are alike, has one of them
  // whatever the samples. Half of it where what never moves of the robot stands in the board.
  double worth(const Board& board) const;

 private:
  const Clearance& clearance_;
  BoardKind kind_;
  double floor_;
};

}  // namespace hbr::inline robots
