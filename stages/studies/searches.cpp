// Layer 1 by searches made of other containers and selectors, measured alike: projected onto one passive grid
// (pipeline/qd/passive_grid.h). Inputs are NAME/RR: search and replication.
#include <map>

#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/qd/passive_grid.h"

namespace {

struct SearchesSlice {
  int passive_cells = 0;
  double worst_fitness = 0;
};
template <class Fields>
void describe(Fields& f, SearchesSlice& s) {
  f.number("passive_cells", s.passive_cells, hbr::Range{1, 1e4},
           "cells a side of the grid that all repertoires are projected onto");
  f.number("worst_fitness", s.worst_fitness, hbr::Range{-1e9, 0}, "a fitness that no elite falls short of");
}

struct Measures {  // one value per replication
  std::vector<double> coverage, qd_score, cell_mean;
};

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<SearchesSlice>();
  const hbr::GridCells cells{2, s.passive_cells, 0, 1};

  hbr::PassiveGrid all(cells);
  std::map<std::string, Measures> searches;
  for (const std::string& input : stage.inputs()) {
    const hbr::Elites elites = hbr::read_elites(stage.input(input));
    hbr::PassiveGrid own(cells);
    own.add(elites);
    all.add(elites);
    Measures& m = searches[input.substr(0, input.find('/'))];
    m.coverage.push_back(static_cast<double>(own.filled()));
    m.qd_score.push_back(own.qd_score(s.worst_fitness));
    m.cell_mean.push_back(own.mean());
  }

  hbr::Hdf5Writer file(stage.output());
  stage.write_settings(file);
  const auto filled_by_any = static_cast<double>(all.filled());
  file.attribute("filled_by_any", filled_by_any);
  for (auto& [name, m] : searches) {
    for (double& share : m.coverage) share /= filled_by_any;
    file.write(name + "/coverage", m.coverage);
    file.write(name + "/qd_score", m.qd_score);
    file.write(name + "/cell_mean", m.cell_mean);
  }
  file.close();
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Searches compared", run); }
