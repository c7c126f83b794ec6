// What the numbers of a repertoire are, for whoever reads them: each kind of layer tells it of its genes, its
// descriptor and its fitness.
#pragma once

#include <string>
#include <vector>

namespace hbr::inline hierarchy {

// A gene, or a coordinate of a descriptor: what it is at the ends of the range in which it is stored; between
// them it is linear.
struct Coordinate {
  std::string name;
  std::string unit;  // "m", "rad", "px"; "" where it has none
  double low, high;  // in that unit, at the least and at the greatest value stored
};
using Coordinates = std::vector<Coordinate>;

struct FitnessMeaning {
  std::string meaning;  // what it is, larger being better
  std::string unit;     // "" where it has none, or where its terms differ
};

// Both coordinates of a place or a displacement in [-most, most]^2, m.
inline Coordinates plane_coordinates(const std::string& name, double most) {
  return {{name + " x", "m", -most, most}, {name + " y", "m", -most, most}};
}

// Appends them, each name led by `lead`.
inline void append(Coordinates& all, const std::string& lead, const Coordinates& more) {
  for (const Coordinate& c : more) all.push_back({lead + c.name, c.unit, c.low, c.high});
}

}  // namespace hbr::inline hierarchy
