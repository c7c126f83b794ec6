// The profile's layers: the hierarchy as a diagram, and what each layer is as a table.
#pragma once

#include <string>
#include <vector>

#include "reports/figures/figures.h"

namespace hbr::inline reports {

// A layer as the profile and its kind (pipeline/hierarchy/layer_kind.h) have it.
struct LayerOfProfile {
  std::string name, kind, meaning;
  std::string below;    // the layer that it is built on; "" where it moves the joints itself
  std::string answers;  // what a command to it names
  std::string asks;     // what it names in its commands to the layer below
};

// An inline SVG: the longest stack of layers above the joints, and beside it the flat baselines, which
// nothing can be built on. `layers` stand after those that they are built on. "" without layers.
std::string hierarchy_diagram(const std::vector<LayerOfProfile>& layers);

// Of each layer what it is, what it commands, what its first replication says of descriptor and fitness, its
// genes and, over the replications, its elites.
std::string layers_table(const std::vector<LayerOfProfile>& layers, const Evidence& evidence);

}  // namespace hbr::inline reports
