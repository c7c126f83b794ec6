#include "pipeline/statistics/table.h"

#include <gtest/gtest.h>

#include <limits>

#include "pipeline/core/check.h"
#include "pipeline/statistics/curves.h"

namespace hbr {
namespace {

TEST(StatisticsTable, QuantitiesInTheOrderOfReplications) {
  StatisticsTable table("tiny");
  for (const int r : {2, 0, 1}) table.add("layer1.size", r, 10.0 * r);
  const nlohmann::json written = table.json();
  EXPECT_EQ(written["profile"], "tiny");
  const nlohmann::json& size = written["quantities"]["layer1.size"];
  EXPECT_EQ(size["values"], (std::vector<double>{0, 10, 20}));
  EXPECT_EQ(size["replications"], (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(size["n"], 3);
  EXPECT_EQ(size["median"], 10);
  EXPECT_EQ(size["q3"], 15);
  EXPECT_EQ(size["unit"], "elites");
}

TEST(StatisticsTable, TestsCompareMedians) {
  StatisticsTable table("tiny");
  for (int r = 0; r < 5; ++r) {
    table.add("accuracy.n1", r, 4 + r);
    table.add("accuracy.n10", r, 1 + 0.1 * r);
    table.add("layer2.n1.best", r, 0);
  }
  table.test("accuracy.n1", "accuracy.n10");
  table.test("accuracy.n1", "layer2.n1.best");
  table.test("accuracy.n1", "accuracy.n100");
  const nlohmann::json tests = table.json()["tests"];
  ASSERT_EQ(tests.size(), 2u);
  const nlohmann::json& test = tests["accuracy.n1_vs_accuracy.n10"];
  EXPECT_EQ(test["a"], "accuracy.n1");
  EXPECT_EQ(test["a12"], 1);
  EXPECT_DOUBLE_EQ(test["ratio"], 6 / 1.2);
  EXPECT_DOUBLE_EQ(test["difference"], 6 - 1.2);
  EXPECT_DOUBLE_EQ(test["p_exact"], 2 / 252.0);
  EXPECT_EQ(test["p"], test["least_p"]);
  EXPECT_FALSE(tests["accuracy.n1_vs_layer2.n1.best"].contains("ratio"));
}

TEST(StatisticsTable, RefusesWhatIsNotANumberOrGivenTwice) {
  StatisticsTable table("tiny");
  EXPECT_THROW(table.add("layer1.best", 0, std::numeric_limits<double>::quiet_NaN()), InputError);
  table.add("layer1.best", 1, 2);
  EXPECT_THROW(table.add("layer1.best", 1, 2), InputError);
  table.number("layer1.genes", 8);
  table.number("layer1.genes", 8);
  EXPECT_THROW(table.number("layer1.genes", 4), InputError);
}

TEST(Curves, KeepWhatAllReplicationsShare) {
  StatisticsTable table("tiny");
  add_curve(table, "layer1", "generation", "size",
            {{{0, 1}, {10, 2}, {20, 3}}, {{0, 3}, {15, 9}, {20, 5}}, {{0, 2}, {10, 7}, {20, 10}}});
  const nlohmann::json curve = table.json()["curves"]["layer1"];
  EXPECT_EQ(curve["at"], (std::vector<double>{0, 20}));
  EXPECT_EQ(curve["n"], 3);
  EXPECT_EQ(curve["size"]["median"], (std::vector<double>{2, 5}));
  EXPECT_EQ(curve["size"]["q3"], (std::vector<double>{2.5, 7.5}));
}

TEST(Curves, ThinnedEvenlyWithBothEnds) {
  Course course;
  for (int i = 0; i <= 10000; ++i) course.emplace_back(i, 2.0 * i);
  StatisticsTable table("tiny");
  add_curve(table, "layer1", "generation", "best", {course});
  const nlohmann::json curve = table.json()["curves"]["layer1"];
  const std::vector<double> at = curve["at"], median = curve["best"]["median"];
  ASSERT_EQ(at.size(), kCurvePoints);
  EXPECT_EQ(at.front(), 0);
  EXPECT_EQ(at.back(), 10000);
  for (std::size_t i = 0; i < at.size(); ++i) {
    EXPECT_EQ(median[i], 2 * at[i]);
    if (i > 0) {
      EXPECT_NEAR(at[i] - at[i - 1], 10000.0 / (kCurvePoints - 1), 1);
    }
  }
}

}  // namespace
}  // namespace hbr
