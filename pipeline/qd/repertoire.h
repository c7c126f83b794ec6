// The container of a quality-diversity search: decides which solutions are kept (Cully and Demiris 2017).
#pragma once

#include "pipeline/qd/elite_store.h"

namespace hbr::inline qd {

enum class Admission { kRejected, kReplaced, kNovel };

struct Added {
  Admission admission;
  Slot slot;  // where the candidate is now; kNoSlot when rejected
};

class Repertoire {
 public:
  Repertoire(int genes, int descriptor_size) : store_(genes, descriptor_size) {}
  virtual ~Repertoire() = default;

  // Judges one candidate against what is held now, and keeps it or not. A copy of an elite that it holds (the
  // same descriptor and fitness) it rejects.
  virtual Added add(const Candidate& candidate) = 0;
  // Takes elites in slot order as they were held by a repertoire of the same kind (resuming a search).
  virtual void restore(const Elites& elites) = 0;

  const EliteStore& store() const { return store_; }
  Slot size() const { return store_.size(); }

 protected:
  EliteStore store_;
};

// The candidate that row i of `elites` once was.
inline Candidate candidate_of(const Elites& elites, Eigen::Index i) {
  return {elites.solution.row(i).data(),
          elites.genes(i),
          elites.measures.row(i).data(),
          elites.objective[i],
          elites.uncertainty.size() ? elites.uncertainty[i] : 0.0f,
          elites.id[i],
          elites.parent[i]};
}

}  // namespace hbr::inline qd
