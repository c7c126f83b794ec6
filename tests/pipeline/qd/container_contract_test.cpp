// What every container promises, in any dimension.
#include <gmock/gmock.h>

#include <algorithm>

#include "pipeline/core/check.h"
#include "pipeline/qd/distance_archive.h"
#include "pipeline/qd/grid_archive.h"
#include "tests/pipeline/qd/containers.h"
#include "tests/pipeline/qd/solutions.h"

namespace hbr {
namespace {

constexpr int kGenes = 4;

class ContainerContract : public testing::TestWithParam<std::tuple<ContainerCase, int>> {
 protected:
  const ContainerCase& container = std::get<0>(GetParam());
  int d = std::get<1>(GetParam());
  std::unique_ptr<Repertoire> repertoire = container.make(kGenes, d);
  const EliteStore& store = repertoire->store();
};

TEST_P(ContainerContract, SaysWhatBecameOfACandidate) {
  Rng rng(Seed(3));
  int novel = 0, replaced = 0, rejected = 0;
  std::vector<std::int64_t> held;  // ids by slot, as it told
  for (int id = 0; id < 4000; ++id) {
    const Solution s = random_solution(rng, id, d, -1);
    const Added added = repertoire->add(s.candidate());
    if (added.admission == Admission::kRejected) {
      ++rejected;
      EXPECT_EQ(added.slot, kNoSlot);
    } else if (added.admission == Admission::kNovel) {
      ++novel;
      ASSERT_EQ(added.slot, static_cast<Slot>(held.size()));  // it only grows, at its end
      held.push_back(id);
    } else {
      ++replaced;
      ASSERT_LT(added.slot, static_cast<Slot>(held.size()));
      held[added.slot] = id;
    }
    ASSERT_EQ(repertoire->size(), static_cast<Slot>(held.size()));
    if (added.admission == Admission::kRejected) continue;
    EXPECT_EQ(store.id(added.slot), id);
    EXPECT_EQ(store.fitness(added.slot), s.fitness);
    ASSERT_EQ(store.length(added.slot), static_cast<int>(s.genome.size()));
    EXPECT_TRUE(std::equal(s.genome.begin(), s.genome.end(), store.genome(added.slot)));
    for (int g = store.length(added.slot); g < kGenes; ++g) EXPECT_EQ(store.genome(added.slot)[g], 0);
    EXPECT_TRUE(std::equal(s.descriptor.begin(), s.descriptor.end(), store.descriptor(added.slot)));
  }
  EXPECT_GT(novel, 20);
  EXPECT_GT(replaced, 20);
  EXPECT_GT(rejected, 20);
  for (Slot s = 0; s < repertoire->size(); ++s) EXPECT_EQ(store.id(s), held[s]);  // slots are stable
}

TEST_P(ContainerContract, HoldsOneElitePerNiche) {
  Rng rng(Seed(7));
  for (int id = 0; id < 3000; ++id) repertoire->add(random_solution(rng, id, d, -1).candidate());
  for (Slot a = 0; a < repertoire->size(); ++a)
    for (Slot b = 0; b < a; ++b)
      ASSERT_FALSE(container.same_niche(store.descriptor(a), store.descriptor(b), d)) << a << ", " << b;
}

TEST_P(ContainerContract, NeverLosesItsBestToAWorse) {
  Rng rng(Seed(8));
  std::vector<Solution> offered;
  for (int id = 0; id < 1500; ++id) {
    const float best = repertoire->size() == 0 ? -2 : repertoire->store().in_id_order().objective.maxCoeff();
    offered.push_back(random_solution(rng, id, d, -1));
    repertoire->add(offered.back().candidate());
    // The dominance of the distance archive trades up to epsilon of quality for novelty.
    const float slack = container.name == "distance" ? 0.1f * std::abs(best) : 0;
    ASSERT_GE(store.in_id_order().objective.maxCoeff(), best - slack);
  }
  if (!container.fitter_only) return;
  for (const Solution& s : offered) {
    int owners = 0;
    for (Slot e = 0; e < repertoire->size(); ++e)
      if (container.same_niche(s.descriptor.data(), store.descriptor(e), d)) {
        ++owners;
        EXPECT_GE(store.fitness(e), s.fitness);
      }
    EXPECT_EQ(owners, 1);
  }
}

TEST_P(ContainerContract, NeverTakesACopyAgain) {
  Rng rng(Seed(4));
  for (int id = 0; id < 500; ++id) {
    const Solution s = random_solution(rng, id, d, -1);
    repertoire->add(s.candidate());
    EXPECT_EQ(repertoire->add(s.candidate()).admission, Admission::kRejected);
  }
}

TEST_P(ContainerContract, RestoredItGoesOnAsBefore) {
  const auto resumed = container.make(kGenes, d);
  Rng rng(Seed(5));
  std::vector<Solution> solutions;
  for (int id = 0; id < 2000; ++id) solutions.push_back(random_solution(rng, id, d, -1));
  for (int id = 0; id < 1000; ++id) repertoire->add(solutions[id].candidate());
  resumed->restore(store.in_slot_order());
  for (int id = 1000; id < 2000; ++id) {
    const Added a = repertoire->add(solutions[id].candidate()), b = resumed->add(solutions[id].candidate());
    ASSERT_EQ(a.admission, b.admission);
    ASSERT_EQ(a.slot, b.slot);
  }
  const Elites a = store.in_id_order(), b = resumed->store().in_id_order();
  EXPECT_EQ(a.id, b.id);
  EXPECT_EQ(a.parent, b.parent);
  EXPECT_EQ(a.solution, b.solution);
  EXPECT_EQ(a.measures, b.measures);
  EXPECT_TRUE(std::is_sorted(a.id.begin(), a.id.end()));
}

// A descriptor belongs to the cell that is nearest to it, however far outside it lies: farther than an int
// can say. From there all centroids of cvt are as near, and the first of them has it.
TEST_P(ContainerContract, TakesWhatLiesFarOutside) {
  std::int64_t id = 0;
  Slot held = 0;
  for (const float far : {1e10f, -1e10f}) {
    const Solution s{{0.5f, 0.5f, 0.5f}, std::vector<float>(static_cast<std::size_t>(d), far), -1, id++};
    const bool novel = held == 0 || container.name != "cvt";
    EXPECT_EQ(repertoire->add(s.candidate()).admission, novel ? Admission::kNovel : Admission::kRejected)
        << far;
    EXPECT_EQ(repertoire->add(s.candidate()).admission, Admission::kRejected) << far;
    held += novel;
  }
  Solution inside{{0.5f, 0.5f, 0.5f}, std::vector<float>(static_cast<std::size_t>(d), 0.3f), -1, id};
  inside.descriptor[0] = 0.5f;
  EXPECT_EQ(repertoire->add(inside.candidate()).slot, held);
}

TEST(GridCells, HasTheNearestForWhatLiesOutside) {
  const GridCells cells{2, 10, 0, 1};
  const auto of = [&](float x, float y) {
    const float descriptor[2] = {x, y};
    return cells.cell_of(descriptor);
  };
  EXPECT_EQ(of(1e10f, 1e10f), 99u);
  EXPECT_EQ(of(-1e10f, 3e38f), 9u);
  EXPECT_EQ(of(1, 0.3f), 93u);
  EXPECT_EQ(of(0.05f, 0.999f), 9u);
}

// What would not fit is refused before it is asked for.
TEST(Containers, RefuseMoreDimensionsOrCellsThanTheyHold) {
  const auto complaint = [](const char* container, int dimensions, int cells) {
    try {
      container_kind(container).make(3, dimensions, {0.1, 0.1, 15, cells, 100, 0, 1}, Seed(1));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(complaint("distance", kMostDimensions, 10), "");
  for (const char* container : {"distance", "local_competition"})
    EXPECT_THAT(complaint(container, kMostDimensions + 1, 10),
                testing::HasSubstr("descriptors of 9 dimensions"));
  EXPECT_EQ(complaint("grid", 2, 100), "");
  EXPECT_THAT(complaint("grid", 8, 256), testing::HasSubstr("256 cells in each of 8 dimensions"));
  EXPECT_THAT(complaint("grid", 16, 16), testing::HasSubstr("fewer grid_cells"));
}

INSTANTIATE_TEST_SUITE_P(AllContainers, ContainerContract,
                         testing::Combine(testing::ValuesIn(all_containers()), testing::Values(1, 2, 3, 6)),
                         [](const auto& instance) {
                           return std::get<0>(instance.param).name + "_in_" +
                                  std::to_string(std::get<1>(instance.param)) + "D";
                         });

}  // namespace
}  // namespace hbr
