// Repertoires of different containers measured alike: their elites are projected onto one passive grid, where
// the fittest of each cell counts (Pugh, Soros and Stanley 2016).
#pragma once

#include <vector>

#include "pipeline/qd/elites.h"
#include "pipeline/qd/grid_archive.h"

namespace hbr::inline qd {

class PassiveGrid {
 public:
  explicit PassiveGrid(const GridCells& cells);

  void add(const Elites& elites);

  std::size_t filled() const;  // cells with an elite
  // Sum over the filled cells of the best fitness above `worst`, a fitness that none falls short of (else
  // InputError): so a filled cell never counts less than an empty one.
  double qd_score(double worst) const;
  // Mean over the filled cells of the best fitness; one must be filled.
  double mean() const;

 private:
  GridCells cells_;
  std::vector<float> best_;  // by cell; minus infinity: empty
};

}  // namespace hbr::inline qd
