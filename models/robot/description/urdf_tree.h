// The links of a URDF as one tree.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "models/robot/description/urdf_text.h"

namespace hbr::inline robots {

struct UrdfTree {
  struct Node {
    const XMLElement* link;
    const XMLElement* joint;  // that the link hangs on; null for the root
    int parent;               // of the nodes; -1 for the root
  };
  std::vector<Node> nodes;  // the root first, parents before children, siblings as in the file
};

// Throws InputError unless the links are one tree, with names of its own for each link and joint.
UrdfTree read_tree(const UrdfText& text);

}  // namespace hbr::inline robots
