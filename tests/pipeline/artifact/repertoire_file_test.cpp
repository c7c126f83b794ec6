#include "pipeline/artifact/repertoire_file.h"

#include <gmock/gmock.h>

#include <cmath>
#include <functional>
#include <limits>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"

namespace hbr {
namespace {

using testing::HasSubstr;

Elites example() {
  Rng rng(Seed(1));
  Elites elites;
  elites.solution = Rows::NullaryExpr(50, 4, [&] { return rng.uniform(); });
  elites.measures = Rows::NullaryExpr(50, 3, [&] { return rng.uniform(-1, 1); });
  elites.objective = Eigen::VectorXf::NullaryExpr(50, [&] { return -rng.uniform(); });
  elites.uncertainty = Eigen::VectorXf::NullaryExpr(50, [&] { return rng.uniform(); });
  for (std::int64_t i = 0; i < 50; ++i) {
    elites.id.push_back(3 * i);
    elites.parent.push_back(i % 5 ? 3 * (i / 5) : -1);
    elites.length.push_back(static_cast<std::int32_t>(1 + i % 4));
  }
  return elites;
}

class RepertoireFile : public testing::Test {
 protected:
  void SetUp() override {
    path_ =
        std::filesystem::path(testing::TempDir()) /
        (std::string("repertoire_") + testing::UnitTest::GetInstance()->current_test_info()->name() + ".h5");
  }
  void TearDown() override { std::filesystem::remove(path_); }
  void write(const Elites& elites, const std::vector<ProgressRow>& progress = {}) {
    Hdf5Writer file(path_);
    write_elites(file, elites, progress);
    file.close();
  }
  std::string complaint(const std::function<void(Elites&)>& spoil) {
    Elites elites = example();
    spoil(elites);
    write(elites);
    try {
      read_elites(path_);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  }
  std::filesystem::path path_;
};

TEST_F(RepertoireFile, RoundTrips) {
  const Elites elites = example();
  write(elites, {{0, 10, -0.5, -0.75, 200}, {100, 50, -0.1, -0.3, 20200}});
  const Elites read = read_elites(path_);
  EXPECT_EQ(read.solution, elites.solution);
  EXPECT_EQ(read.measures, elites.measures);
  EXPECT_EQ(read.objective, elites.objective);
  EXPECT_EQ(read.uncertainty, elites.uncertainty);
  EXPECT_EQ(read.id, elites.id);
  EXPECT_EQ(read.parent, elites.parent);
  EXPECT_EQ(read.length, elites.length);
  const std::vector<ProgressRow> progress = read_progress(path_);
  ASSERT_EQ(progress.size(), 2u);
  EXPECT_EQ(progress[1].generation, 100);
  EXPECT_EQ(progress[1].size, 50);
  EXPECT_EQ(progress[1].best, -0.1);
  EXPECT_EQ(progress[1].mean, -0.3);
  EXPECT_EQ(progress[1].evaluations, 20200);
}

TEST_F(RepertoireFile, OptionalArraysStayAbsent) {
  Elites elites = example();
  elites.length.clear();
  elites.uncertainty.resize(0);
  write(elites);
  EXPECT_FALSE(Hdf5Reader(path_).has("length"));
  const Elites read = read_elites(path_);
  EXPECT_TRUE(read.length.empty());
  EXPECT_EQ(read.uncertainty.size(), 0);
}

TEST_F(RepertoireFile, RefusesWhatNoSearchLeaves) {
  EXPECT_THAT(complaint([](Elites& e) { e.solution(3, 1) = 1.5f; }),
              HasSubstr("solution: expected genes in [0, 1]"));
  EXPECT_THAT(complaint([](Elites& e) { e.measures(3, 1) = std::nanf(""); }),
              HasSubstr("measures: expected finite numbers, found nan at place 10"));
  EXPECT_THAT(complaint([](Elites& e) { e.objective(0) = -std::numeric_limits<float>::infinity(); }),
              HasSubstr("objective: expected finite numbers, found -inf"));
  EXPECT_THAT(complaint([](Elites& e) { std::swap(e.id[4], e.id[5]); }),
              HasSubstr("id: expected ascending ids"));
  EXPECT_THAT(complaint([](Elites& e) { e.parent[7] = 22; }),
              HasSubstr("parent: expected -1 or an id below"));
  EXPECT_THAT(complaint([](Elites& e) { e.length[7] = 5; }),
              HasSubstr("length: expected 1 to 4 genes, found 5"));

  const Elites elites = example();
  Hdf5Writer file(path_);
  file.write("measures", {50, 3}, elites.measures.data());
  file.write("solution", {49, 4}, elites.solution.data());
  file.close();
  try {
    read_elites(path_);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr("solution: expected 50 rows, one for each elite, found 49"));
  }
}

}  // namespace
}  // namespace hbr
