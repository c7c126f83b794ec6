// The numbers of a URDF, checked where their line is still known: urdfdom names none.
#pragma once

#include <string>

class TiXmlElement;

namespace hbr {

// Throws InputError where an attribute of a link's or joint's shape, place, mass, axis, limit or colour is
// not as many numbers as it should be, or one is larger than anything is.
void check_numbers(const std::string& path, const TiXmlElement& robot);

}  // namespace hbr
