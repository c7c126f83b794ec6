#include "pipeline/qd/passive_grid.h"

#include <algorithm>
#include <limits>

#include "pipeline/core/check.h"

namespace hbr::inline qd {
namespace {
constexpr float kEmpty = -std::numeric_limits<float>::infinity();
}

PassiveGrid::PassiveGrid(const GridCells& cells) : cells_(cells), best_(cells.size(), kEmpty) {}

void PassiveGrid::add(const Elites& elites) {
  HBR_CHECK(elites.measures.cols() == cells_.descriptor_size, "descriptor size {}", elites.measures.cols());
  for (Eigen::Index i = 0; i < elites.size(); ++i) {
    float& best = best_[cells_.cell_of(elites.measures.row(i).data())];
    best = std::max(best, elites.objective[i]);
  }
}

std::size_t PassiveGrid::filled() const {
  return best_.size() - static_cast<std::size_t>(std::count(best_.begin(), best_.end(), kEmpty));
}

double PassiveGrid::qd_score(double worst) const {
  double sum = 0;
  for (const float best : best_)
    if (best != kEmpty) {
      if (best < static_cast<float>(worst))
        throw InputError("a fitness of {}; expected none below the worst there can be, {}", best, worst);
      sum += static_cast<double>(best) - worst;
    }
  return sum;
}

double PassiveGrid::mean() const {
  HBR_CHECK(filled() > 0, "{} cells, all empty", best_.size());
  double sum = 0;
  for (const float best : best_)
    if (best != kEmpty) sum += static_cast<double>(best);
  return sum / static_cast<double>(filled());
}

}  // namespace hbr::inline qd
