#include "pipeline/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <vector>

namespace hbr {
namespace {

TEST(Workers, EveryIndexOnceForAnyNumberOfThreads) {
  for (const int threads : {1, 2, 5}) {
    Workers workers(threads);
    std::vector<std::atomic<int>> visits(1001);
    workers.for_each(visits.size(), [&](std::size_t i) { ++visits[i]; });
    for (const auto& v : visits) EXPECT_EQ(v, 1);
    workers.for_each(0, [](std::size_t) { FAIL() << "an empty loop has no body"; });
  }
}

TEST(Workers, RangesCoverAllAndAreNoShorterThanHalfAGrain) {
  for (const int threads : {1, 2, 5}) {
    Workers workers(threads);
    constexpr std::size_t n = 1000, grain = 300;
    std::vector<std::atomic<std::size_t>> end_of(n);  // by where a range begins
    workers.for_ranges(n, grain, [&](std::size_t begin, std::size_t end) { end_of[begin] = end; });
    std::size_t at = 0;
    while (at < n) {
      ASSERT_GE(end_of[at], at + grain / 2) << threads << " threads, at " << at;
      at = end_of[at];
    }
    EXPECT_EQ(at, n);
  }
}

TEST(Workers, AnExceptionReachesTheCaller) {
  Workers workers(2);
  EXPECT_THROW(workers.for_each(10,
                                [](std::size_t i) {
                                  if (i == 7) throw std::runtime_error("seven");
                                }),
               std::runtime_error);
}

}  // namespace
}  // namespace hbr
