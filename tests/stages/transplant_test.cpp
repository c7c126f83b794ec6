// Elites from elsewhere at the start of a search.
#include "stages/transplant.h"

#include <gtest/gtest.h>

#include <fstream>

#include "pipeline/core/check.h"
#include "pipeline/qd/distance_archive.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

// The first two genes are the descriptor, the third the fitness.
class Echo final : public Evaluator {
 public:
  int descriptor_size() const override { return 2; }
  bool deterministic() const override { return true; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed) const override {
    for (Eigen::Index i = begin; i < end; ++i) {
      batch.descriptor.row(i) = batch.genome.row(i).head<2>();
      batch.fitness[i] = batch.genome(i, 2);
      batch.valid[static_cast<std::size_t>(i)] = 1;
    }
  }
};

Elites random_elites(int n) {
  Rng rng(Seed(1));
  Elites elites;
  elites.solution = Rows(n, 3);
  for (float& gene : elites.solution.reshaped()) gene = rng.uniform();
  elites.measures = elites.solution.leftCols<2>();
  elites.objective = elites.solution.col(2);
  for (int i = 0; i < n; ++i) {
    elites.id.push_back(3 * i);
    elites.parent.push_back(-1);
  }
  return elites;
}

class Transplant : public testing::Test {
 protected:
  Transplant() {
    table_.batch = 10;
    table_.record_every = 1;
    table_.container = "distance";
    table_.spacing = 0.1;
    table_.epsilon = 0.1;
    table_.neighbours = 5;
    table_.selector = "curiosity";
    table_.curiosity_credit = "parent";
    table_.mutation_rate = 0.5;
    table_.mutation_eta = 10;
    std::ofstream(folder_.path() / "slice.json")
        << R"({"stage": "s", "name": "s/00", "settings": {}, "inputs": {}, "output": "s/00.h5"})";
  }
  // The search that goes on from the transplant after 100 generations, for `more`.
  Elites evolve_on(const Elites& elites, std::int64_t more) {
    const std::filesystem::path checkpoint = folder_.path() / "checkpoint",
                                output = folder_.path() / "out.h5";
    StageRun stage(folder_.path() / "slice.json", folder_.path(), output, checkpoint, 1);
    write_transplant(checkpoint, table_, elites, 100, {});
    table_.generations = 100 + more;
    evolve(stage, table_, fixed_length(3, table_), Echo(), Seed(2));
    return read_elites(output);
  }

  TemporaryFolder folder_;
  SearchTable table_;
};

TEST_F(Transplant, HoldsWhatTheContainerKeeps) {
  const Elites elites = random_elites(300);
  const auto archive = make_distance_archive(3, 2, {0.1f, 0.1f, 5, 0, 1});
  for (Eigen::Index i = 0; i < elites.size(); ++i) archive->add(candidate_of(elites, i));
  const Elites expected = archive->store().in_id_order(), found = evolve_on(elites, 0);
  ASSERT_LT(expected.size(), 200);
  EXPECT_EQ(found.id, expected.id);
  EXPECT_EQ(found.solution, expected.solution);
  EXPECT_EQ(found.objective, expected.objective);
}

TEST_F(Transplant, GoesOnFromThere) {
  const Elites elites = random_elites(30), found = evolve_on(elites, 80);
  EXPECT_EQ(read_progress(folder_.path() / "out.h5").front().generation, 101);
  int old = 0, grown = 0;
  for (Eigen::Index i = 0; i < found.size(); ++i) {
    const std::int64_t id = found.id[static_cast<std::size_t>(i)],
                       parent = found.parent[static_cast<std::size_t>(i)];
    if (id < 1000) {
      ++old;
      EXPECT_EQ(found.solution.row(i), elites.solution.row(id / 3)) << id;
    } else {
      ++grown;
      EXPECT_GE(parent, 0);  // nobody is drawn at random
    }
  }
  EXPECT_GT(old, 5);
  EXPECT_GT(grown, 20);
}

TEST_F(Transplant, RefusesCells) {
  table_.container = "cvt";
  EXPECT_THROW(write_transplant(folder_.path() / "c", table_, random_elites(3), 1, {}), InputError);
}

}  // namespace
}  // namespace hbr
