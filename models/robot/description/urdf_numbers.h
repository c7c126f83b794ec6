// The numbers of a URDF, checked where their line is still known: urdfdom names none.
#pragma once

#include <string>

namespace tinyxml2 {
class XMLElement;
}

namespace hbr {

// Throws InputError where an attribute of a link's or joint's shape, place, mass, axis, limit or colour is
// not as many numbers as it should be, or one is larger than anything is.
void check_numbers(const std::string& path, const tinyxml2::XMLElement& robot);

}  // namespace hbr
