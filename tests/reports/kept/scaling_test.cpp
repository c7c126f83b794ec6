#include "reports/kept/scaling.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "pipeline/core/random.h"

namespace hbr {
namespace {

double total(const std::vector<Job>& jobs) {
  return std::accumulate(jobs.begin(), jobs.end(), 0.0,
                         [](double sum, const Job& job) { return sum + job.seconds; });
}
double length(const std::vector<Job>& jobs, const std::vector<std::size_t>& path) {
  double sum = 0;
  for (const std::size_t i : path) sum += jobs[i].seconds;
  return sum;
}

TEST(Scaling, AChainTakesItsTimeOnAnyNumber) {
  const std::vector<Job> chain{{"a", 2, {}}, {"b", 3, {0}}, {"c", 4, {1}}};
  for (const int processors : {1, 2, 64}) EXPECT_EQ(makespan(chain, processors), 9);
  EXPECT_EQ(critical_path(chain), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(Scaling, EqualJobsAreShared) {
  const std::vector<Job> jobs(12, Job{"a", 5, {}});
  EXPECT_EQ(makespan(jobs, 1), 60);
  EXPECT_EQ(makespan(jobs, 5), 15);
  EXPECT_EQ(makespan(jobs, 12), 5);
  EXPECT_EQ(makespan({}, 3), 0);
}

TEST(Scaling, WhatALongChainWaitsForGoesFirst) {
  // Two processors: the head of the chain first, then the rest beside it.
  const std::vector<Job> jobs{{"rest", 4, {}}, {"rest", 4, {}}, {"head", 4, {}}, {"tail", 8, {2}}};
  EXPECT_EQ(makespan(jobs, 2), 12);
  EXPECT_EQ(critical_path(jobs), (std::vector<std::size_t>{2, 3}));
}

// Any order that leaves no processor idle without need ends between these bounds.
TEST(Scaling, StaysWithinGrahamsBounds) {
  Rng rng{Seed(5)};
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Job> jobs;
    for (std::size_t i = 0; i < 40; ++i) {
      Job job{"a", rng.uniform(1, 10), {}};
      for (std::size_t before = 0; before < i; ++before)
        if (rng.uniform() < 0.05f) job.after.push_back(before);
      jobs.push_back(job);
    }
    const double chain = length(jobs, critical_path(jobs));
    EXPECT_NEAR(makespan(jobs, 1), total(jobs), 1e-9);
    EXPECT_NEAR(makespan(jobs, 40), chain, 1e-9);
    for (const int processors : {2, 3, 7}) {
      const double found = makespan(jobs, processors);
      EXPECT_GE(found, std::max(chain, total(jobs) / processors) - 1e-9);
      EXPECT_LE(found, total(jobs) / processors + chain * (processors - 1) / processors + 1e-9);
    }
  }
}

}  // namespace
}  // namespace hbr
