// What every search of a layer is told.
#pragma once

#include <cstdint>
#include <string>

#include "pipeline/core/settings.h"
#include "pipeline/qd/containers.h"
#include "pipeline/qd/named.h"
#include "pipeline/qd/neighbour_grid.h"
#include "pipeline/qd/selectors.h"

namespace hbr::inline stages {

struct SearchTable {
  std::int64_t generations = 0;
  int batch = 0;
  std::int64_t record_every = 0;
  std::string container;
  double spacing = 0;
  double epsilon = 0;
  int neighbours = 0;
  int grid_cells = 0;
  int cvt_cells = 0;
  std::string selector;
  std::string curiosity_credit;
  std::string mutation;
  double mutation_rate = 0;
  double mutation_eta = 0;
};

// Which elites are kept and which are bred from.
template <class Fields>
void describe_algorithm(Fields& f, SearchTable& s) {
  f.choice("container", s.container, names_of(container_kinds()),
           ("which elites are kept: " + meanings_of(container_kinds())).c_str());
  f.choice("selector", s.selector, names_of(selector_kinds()),
           ("how parents are drawn: " + meanings_of(selector_kinds())).c_str());
}
// The part of a search that all layers share, [search] in a profile.
template <class Fields>
void describe_search(Fields& f, SearchTable& s) {
  f.number("batch", s.batch, Range{1, 1e6}, "children of a generation (pop_size)");
  f.number("record_every", s.record_every, Range{1, 1e9}, "generations between two rows of progress");
  describe_algorithm(f, s);
  f.number("neighbours", s.neighbours, Range{1, kMaxNeighbours},
           "k: neighbours that the novelty score averages");
  f.number("grid_cells", s.grid_cells, Range{1, 1e4}, "cells a side of the grid container");
  f.number("cvt_cells", s.cvt_cells, Range{1, 1e6}, "cells of the cvt container");
  f.choice("curiosity_credit", s.curiosity_credit, {"parent", "published"},
           "whom a child counts for: its own parent, or that of some sibling as in the published program");
  f.choice("mutation", s.mutation, {"each", "at_least_one", "every"},
           "which genes of a child mutate: each with the probability mutation_rate; so, but one at random "
           "where none did; or every one, whatever the rate");
  f.number("mutation_rate", s.mutation_rate, Range{0, 1}, "probability that a gene mutates");
  f.number("mutation_eta", s.mutation_eta, Range{0, 1000}, "eta_m of the polynomial mutation");
}
// The part of each layer.
template <class Fields>
void describe_archive(Fields& f, SearchTable& s) {
  f.number("spacing", s.spacing, Range{1e-4, 10},
           "l: distance beyond which a solution is novel, descriptor units");
  f.number("epsilon", s.epsilon, Range{0, 0.99}, "of the epsilon-dominance");
}
template <class Fields>
void describe_generations(Fields& f, SearchTable& s) {
  f.number("generations", s.generations, Range{1, 1e9}, "generations, the random one included");
}
template <class Fields>
void describe(Fields& f, SearchTable& s) {
  describe_search(f, s);
  describe_archive(f, s);
  describe_generations(f, s);
}

}  // namespace hbr::inline stages
