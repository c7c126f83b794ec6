// A joint of a URDF, and which joints follow which.
#pragma once

#include "models/robot/description/robot_model.h"
#include "models/robot/description/urdf_text.h"

namespace hbr::inline robots {

// Without its links and what it follows. What cannot move as it says stands still, and and text.odd gets a
// line. Throws InputError for a type that no URDF has.
Joint read_joint(UrdfText& text, const XMLElement& joint);

// Fills in what the joints follow by their <mimic>; elements[i] is that of joints[i]. A joint that follows a
// follower follows what moves both; one that follows a fixed joint stands still, one that follows a joint
// that is not in the file moves by itself, with a line in text.odd. Throws InputError where joints follow
// each other in a loop.
void link_mimics(UrdfText& text, const std::vector<const XMLElement*>& elements, std::vector<Joint>& joints);

}  // namespace hbr::inline robots
