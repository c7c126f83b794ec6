// The contenders of the experiments: one name and one colour each, the same in every figure.
#pragma once

#include <string>

#include "reports/plot/colour.h"

namespace hbr::inline reports {

struct Contender {
  std::string name;   // as the statistics call it: "layer2.n10", "flat_arcs"
  std::string label;  // as a figure calls it: "10 samples"
  Colour colour;
};

// Of a search, a quantity or a box of the statistics. A name that is in no table of ours labels itself and is
// drawn in grey.
Contender contender(const std::string& name);

// A robot of the profile as figures call it: "NAO", "NAO left", "Industrial".
std::string robot_title(const std::string& name);

}  // namespace hbr::inline reports
