// Two searches that must be the same.
#pragma once

#include <gtest/gtest.h>

#include "pipeline/qd/search.h"

namespace hbr {

inline void expect_same(const SearchState& a, const SearchState& b) {
  EXPECT_EQ(a.elites.id, b.elites.id);
  EXPECT_EQ(a.elites.parent, b.elites.parent);
  EXPECT_EQ(a.elites.solution, b.elites.solution);
  EXPECT_EQ(a.elites.measures, b.elites.measures);
  EXPECT_EQ(a.elites.objective, b.elites.objective);
  EXPECT_EQ(a.selector, b.selector);
  ASSERT_EQ(a.progress.size(), b.progress.size());
  for (std::size_t i = 0; i < a.progress.size(); ++i) {
    EXPECT_EQ(a.progress[i].generation, b.progress[i].generation);
    EXPECT_EQ(a.progress[i].mean, b.progress[i].mean);
  }
}

}  // namespace hbr
