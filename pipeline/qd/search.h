// The quality-diversity search: select, vary, evaluate, add (Cully and Demiris 2017, algorithm 1).
//
// A generation is bred and evaluated in parallel and added one child at a time in index order, so that any
// number of threads gives the same repertoire. All randomness comes from the seed by names and indices.
#pragma once

#include <functional>
#include <vector>

#include "pipeline/core/parallel.h"
#include "pipeline/core/random.h"
#include "pipeline/qd/evaluator.h"
#include "pipeline/qd/repertoire.h"
#include "pipeline/qd/selector.h"
#include "pipeline/qd/variation.h"

namespace hbr::inline qd {

// Whom a selector credits with a child. The published program of Cully and Demiris (sferes2's modular_QD)
// shuffles the parents before it breeds them, but credits them in the order in which they were drawn: every
// child counts for the parent of some sibling.
enum class Credit { kParent, kPublished };

struct SearchSettings {
  std::int64_t generations;   // the first is random, all are of the same size
  int batch;                  // children of a generation
  std::int64_t record_every;  // generations between two progress rows; the last one always has a row
  Credit credit = Credit::kParent;
};

// All that a search needs to go on as if it had never stopped.
struct SearchState {
  std::int64_t generation = 0;  // generations done
  Elites elites;                // in slot order
  std::vector<std::int64_t> selector;
  std::vector<ProgressRow> progress;
};

class Search {
 public:
  Search(Repertoire& repertoire, Selector& selector, const Variation& variation, const Evaluator& evaluator,
         const SearchSettings& settings, Seed seed);

  // Before the first step.
  void resume(const SearchState& state);
  SearchState state() const;

  bool done() const { return generation_ == settings_.generations; }
  std::int64_t generation() const { return generation_; }
  const std::vector<ProgressRow>& progress() const { return progress_; }

  void step(Workers& workers);

 private:
  // A child that is a copy of its parent (with eight genes, 43 % are) does what its parent did; where the
  // evaluator is deterministic it is not evaluated again, and while its parent is there it is not even
  // offered: a repertoire never keeps two of a kind.
  void select_parents();
  void breed(Workers& workers);
  void evaluate(Workers& workers);
  void add();
  void record();

  Repertoire& repertoire_;
  Selector& selector_;
  const Variation& variation_;
  const Evaluator& evaluator_;
  SearchSettings settings_;
  Seed seed_;

  std::int64_t generation_ = 0;
  Batch batch_;
  std::vector<Slot> parent_slot_;
  std::vector<std::int64_t> parent_id_;
  std::vector<int> credited_;       // [child] the child whose parent is credited
  std::vector<std::uint8_t> copy_;  // children equal to their parents, of a deterministic evaluator
  Batch fresh_;                     // the others, without gaps
  std::vector<ProgressRow> progress_;
};

}  // namespace hbr::inline qd
