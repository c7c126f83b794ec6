// A link of a URDF: its mass and what it looks like.
#pragma once

#include <map>

#include "models/robot/description/robot_model.h"
#include "models/robot/description/urdf_text.h"

namespace hbr::inline robots {

struct Colours {
  std::map<const XMLElement*, Eigen::Vector3f> own;  // of each <material> that names one
  std::map<std::string, Eigen::Vector3f> named;      // the first that a material of this name has
};
Colours read_colours(UrdfText& text);

// What cannot be shown or weighed is left out, and text.odd gets a line.
Link read_link(UrdfText& text, const XMLElement& link, const Colours& colours);

}  // namespace hbr::inline robots
