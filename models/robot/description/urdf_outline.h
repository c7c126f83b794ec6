// The names, lines and tree of a URDF, checked before its contents are read: what urdfdom takes without a
// word (a link with two parents, a loop beside the tree) or reports without its place.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hbr {

struct UrdfOutline {
  struct Link {
    std::string name;
    int line;
  };
  struct Joint {
    std::string name, parent, child;
    int line;
  };
  std::vector<Link> links;    // the root first, parents before children, siblings as in the file
  std::vector<Joint> joints;  // joints[i].child is links[i + 1].name
};

// Throws InputError unless `text`, the contents of the file `path`, is a robot whose links are one tree, with
// names of its own for each, joints of known types and numbers that are some.
UrdfOutline read_outline(const std::filesystem::path& path, const std::string& text);

}  // namespace hbr
