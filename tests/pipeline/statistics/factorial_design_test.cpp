#include "pipeline/statistics/factorial_design.h"

#include <gmock/gmock.h>

#include <map>
#include <set>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

using testing::HasSubstr;

// How often each combination of levels of some factors is among the runs.
std::map<Levels, int> counts(const std::vector<Levels>& runs, const std::vector<std::size_t>& factors) {
  std::map<Levels, int> count;
  for (const Levels& run : runs) {
    Levels part;
    for (const std::size_t f : factors) part.push_back(run[f]);
    ++count[part];
  }
  return count;
}

TEST(FactorialDesign, IsEveryCombinationInOrder) {
  const std::vector<Levels> all = factorial_design({2, 3}, 0);
  EXPECT_EQ(all, (std::vector<Levels>{{0, 0}, {0, 1}, {0, 2}, {1, 0}, {1, 1}, {1, 2}}));
  EXPECT_EQ(factorial_design({2, 3}, 6), all);
  EXPECT_EQ(factorial_design({2, 3}, 99), all);
  EXPECT_EQ(factorial_design({}, 0), std::vector<Levels>{{}});
}

// The known best fractions: eight of sixteen in which any three of four factors are complete (resolution IV),
// sixteen of thirty-two in which any four of five are (resolution V).
TEST(FactorialDesign, FindsTheHalvesOfTwoLevels) {
  const std::vector<Levels> half4 = factorial_design({2, 2, 2, 2}, 8),
                            half5 = factorial_design({2, 2, 2, 2, 2}, 16);
  ASSERT_EQ(half4.size(), 8u);
  for (std::size_t without = 0; without < 4; ++without) {
    std::vector<std::size_t> three;
    for (std::size_t f = 0; f < 4; ++f)
      if (f != without) three.push_back(f);
    EXPECT_EQ(counts(half4, three).size(), 8u) << without;
  }
  ASSERT_EQ(half5.size(), 16u);
  for (std::size_t without = 0; without < 5; ++without) {
    std::vector<std::size_t> four;
    for (std::size_t f = 0; f < 5; ++f)
      if (f != without) four.push_back(f);
    EXPECT_EQ(counts(half5, four).size(), 16u) << without;
  }
  for (const auto& runs : {half4, half5})
    EXPECT_EQ(std::set<Levels>(runs.begin(), runs.end()).size(), runs.size());
}

TEST(FactorialDesign, HoldsEveryLevelEquallyOften) {
  const std::vector<int> levels{3, 2, 2, 2, 2, 2};  // 96 combinations
  const std::vector<Levels> runs = factorial_design(levels, 24);
  ASSERT_EQ(runs.size(), 24u);
  EXPECT_EQ(runs[0], Levels(6, 0));
  EXPECT_TRUE(std::ranges::is_sorted(runs));
  for (std::size_t f = 0; f < levels.size(); ++f)
    for (std::size_t g = f + 1; g < levels.size(); ++g)
      for (const auto& [pair, count] : counts(runs, {f, g}))
        EXPECT_EQ(count, 24 / (levels[f] * levels[g])) << f << ' ' << g;
}

TEST(FactorialDesign, RefusesWhatNobodyRuns) {
  EXPECT_THAT([] { factorial_design(std::vector<int>(17, 2), 8); },
              testing::ThrowsMessage<InputError>(HasSubstr("more than 65536 combinations")));
}

}  // namespace
}  // namespace hbr
