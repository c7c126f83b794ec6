// Elites from elsewhere at the start of a search.
#include "stages/layers/warm_start.h"

#include <gtest/gtest.h>

#include <fstream>

#include "pipeline/core/check.h"
#include "pipeline/qd/distance_archive.h"
#include "stages/layers/checkpoint.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

const GenomeShape kThreeGenes{Coordinates(3)};

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

class WarmStart : public testing::Test {
 protected:
  WarmStart() {
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
  // The search that goes on from the warm start after 100 generations, for `more`.
  Elites from_checkpoint(const Elites& elites, std::int64_t more) {
    const std::filesystem::path checkpoint = folder_.path() / "checkpoint",
                                output = folder_.path() / "out.h5";
    StageRun stage(folder_.path() / "slice.json", folder_.path(), output, checkpoint, 1);
    write_warm_start(checkpoint, table_, elites, 100, {});
    table_.generations = 100 + more;
    evolve(stage, table_, *make_variation(kThreeGenes, table_), Echo(), Seed(2));
    return read_elites(output);
  }

  TemporaryFolder folder_;
  SearchTable table_;
};

// A checkpoint in pieces is as none: what is made from the beginning is the same.
TEST_F(WarmStart, ADamagedCheckpointIsAsNone) {
  const std::filesystem::path checkpoint = folder_.path() / "damaged";
  EXPECT_FALSE(can_resume(checkpoint));
  write_warm_start(checkpoint, table_, random_elites(100), 100, {});
  EXPECT_TRUE(can_resume(checkpoint));
  std::filesystem::resize_file(checkpoint, std::filesystem::file_size(checkpoint) / 2);
  EXPECT_FALSE(can_resume(checkpoint));
  EXPECT_FALSE(std::filesystem::exists(checkpoint));
  std::ofstream(checkpoint).flush();
  EXPECT_FALSE(can_resume(checkpoint));
}

// Nothing is lost of a finished search whose elites do here what they did there: the search goes on.
TEST_F(WarmStart, KeepsAllOfAFinishedSearch) {
  const Elites finished = from_checkpoint(random_elites(300), 200), found = from_checkpoint(finished, 0);
  float nearest = 1;
  for (Eigen::Index i = 0; i < finished.size(); ++i)
    for (Eigen::Index k = 0; k < i; ++k)
      nearest = std::min(nearest, (finished.measures.row(i) - finished.measures.row(k)).norm());
  ASSERT_LT(nearest, 0.099f) << "none stands nearer than l, and nothing is tried";
  EXPECT_EQ(found.id, finished.id);
  EXPECT_EQ(found.solution, finished.solution);
}

TEST_F(WarmStart, HoldsWhatTheContainerKeeps) {
  const Elites elites = random_elites(300);
  const auto archive = make_distance_archive(3, 2, {0.09f, 0, 5, 0, 1});
  for (Eigen::Index i = 0; i < elites.size(); ++i) archive->add(candidate_of(elites, i));
  const Elites expected = archive->store().in_id_order(), found = from_checkpoint(elites, 0);
  ASSERT_LT(expected.size(), 200);
  EXPECT_EQ(found.id, expected.id);
  EXPECT_EQ(found.solution, expected.solution);
  EXPECT_EQ(found.objective, expected.objective);
}

TEST_F(WarmStart, GoesOnFromThere) {
  const Elites elites = random_elites(30), found = from_checkpoint(elites, 80);
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

// Mirrors the first gene, draws the second from its seed, and refuses genomes whose third is high.
class Elsewhere final : public Evaluator {
 public:
  int descriptor_size() const override { return 2; }
  bool stochastic() const override { return true; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override {
    for (Eigen::Index i = begin; i < end; ++i) {
      const auto row = static_cast<std::size_t>(i);
      batch.valid[row] = batch.genome(i, 2) < 0.9f;
      batch.descriptor.row(i) << 1 - batch.genome(i, 0), Rng(seed.child(row)).uniform();
      batch.fitness[i] = -batch.genome(i, 1);
      batch.uncertainty[i] = batch.genome(i, 2);
    }
  }
};

TEST_F(WarmStart, DescribesElitesAsTheyAreHere) {
  const Elites elites = random_elites(200);
  Workers workers(2);
  const Elites here = described(elites, Elsewhere(), Seed(5), workers);
  ASSERT_GT(here.size(), 150);
  Eigen::Index at = 0;
  for (Eigen::Index i = 0; i < elites.size(); ++i) {
    if (elites.solution(i, 2) >= 0.9f) continue;
    const auto row = static_cast<std::size_t>(i);
    EXPECT_EQ(here.id[static_cast<std::size_t>(at)], elites.id[row]);
    EXPECT_EQ(here.solution.row(at), elites.solution.row(i));
    EXPECT_EQ(here.measures(at, 0), 1 - elites.solution(i, 0));
    EXPECT_EQ(here.measures(at, 1), Rng(Seed(5).child(row)).uniform());
    EXPECT_EQ(here.objective[at], -elites.solution(i, 1));
    EXPECT_EQ(here.uncertainty[at], elites.solution(i, 2));
    ++at;
  }
  EXPECT_EQ(here.size(), at);
}

// No generation more: what the container keeps of the elites as they are here; of one more, the rest of it.
TEST_F(WarmStart, EvolvesOnFromWhatTheElitesAreHere) {
  const Elites elites = random_elites(100);
  const auto evolved = [&](std::int64_t more) {
    const std::filesystem::path checkpoint = folder_.path() / fmt::format("c{}", more),
                                output = folder_.path() / fmt::format("{}.h5", more);
    StageRun stage(folder_.path() / "slice.json", folder_.path(), output, checkpoint, 1);
    table_.generations = 100;
    evolve_on(stage, table_, more, elites, *make_variation(kThreeGenes, table_), Elsewhere(), Seed(2));
    return read_elites(output);
  };
  const Elites kept = evolved(0), grown = evolved(20);
  Workers workers(1);
  const Elites here = described(elites, Elsewhere(), Seed(2).child("described"), workers);
  const auto archive = make_distance_archive(3, 2, {0.09f, 0, 5, 0, 1});
  for (Eigen::Index i = 0; i < here.size(); ++i) archive->add(candidate_of(here, i));
  EXPECT_EQ(kept.id, archive->store().in_id_order().id);
  EXPECT_EQ(read_progress(folder_.path() / "20.h5").front().generation, 81);
  EXPECT_EQ(read_progress(folder_.path() / "20.h5").back().generation, 100);
  for (const std::int64_t id : grown.id) EXPECT_TRUE(id < 300 || (id >= 800 && id < 1000)) << id;
  EXPECT_GE(grown.size(), kept.size());
}

TEST_F(WarmStart, RefusesCells) {
  table_.container = "cvt";
  EXPECT_THROW(write_warm_start(folder_.path() / "c", table_, random_elites(3), 1, {}), InputError);
}

}  // namespace
}  // namespace hbr
