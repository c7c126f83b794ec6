// The profile's layers, in every replication.
#include "stages/plan/plan.h"

namespace hbr::inline stages {

void plan_layers(Plan& plan) {
  for (const LayerRow& row : plan.rows())
    for (int r = 0; r < plan.replications(row); ++r)
      plan.add_layer(row.name, row, r, plan.arm(), plan.inputs("below", plan.stack(row.below), r));
}

}  // namespace hbr::inline stages
