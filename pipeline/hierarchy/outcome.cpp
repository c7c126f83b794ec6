#include "pipeline/hierarchy/outcome.h"

namespace hbr::inline hierarchy {

void SampledOutcome::measure(const Executions& executions, float* descriptor, float* fitness) const {
  std::vector<float*> coordinates(descriptor_size());
  for (int e = 0; e < executions.size(); ++e) {
    for (float*& coordinate : coordinates) coordinate = descriptor++;
    describe(executions, e, 1, coordinates.data());
    fitness[e] = static_cast<float>(this->fitness(executions, e));
  }
}

}  // namespace hbr::inline hierarchy
