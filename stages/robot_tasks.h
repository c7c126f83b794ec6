// What a profile says of the experiments with other robots.
#pragma once

#include "pipeline/artifact/settings.h"

namespace hbr {

struct TransferTable {
  int starts = 0;
};
template <class Fields>
void describe(Fields& f, TransferTable& s) {
  f.number("starts", s.starts, Range{1, 1e4}, "common starts from which each line and arc is executed");
}

}  // namespace hbr
