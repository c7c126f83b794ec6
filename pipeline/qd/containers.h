// The containers by name, as a profile calls them. To add one: its own file, and its row in containers.cpp.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "pipeline/core/random.h"
#include "pipeline/qd/repertoire.h"

namespace hbr::inline qd {

// Each container takes what it needs.
struct ContainerSettings {
  double spacing;   // l: distance beyond which a solution is novel, descriptor units
  double epsilon;   // of the epsilon-dominance, in [0, 1)
  int neighbours;   // k of the novelty score, 1 to kMaxNeighbours
  int grid_cells;   // a side
  int cvt_cells;    // in all
  float low, high;  // range of the descriptor, the same in every dimension
};

struct Container {
  std::unique_ptr<Repertoire> repertoire;
  Rows centroids = {};  // of its cells where they were drawn, [cells x descriptor_size]
};

struct ContainerKind {
  const char* name;
  const char* meaning;
  bool draws_cells;  // for each search, so that it can't go on from another's elites
  // A function of its arguments alone; the seed is for cells that are drawn.
  Container (*make)(int genes, int descriptor_size, const ContainerSettings& settings, Seed seed);
};

std::span<const ContainerKind> container_kinds();
// Throws InputError for another name.
const ContainerKind& container_kind(const std::string& name);

}  // namespace hbr::inline qd
