// What a search still replaces late, against a repertoire that is told of every replacement.
#include <gmock/gmock.h>

#include <algorithm>

#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/core/check.h"
#include "pipeline/core/random.h"
#include "pipeline/statistics/collect.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

constexpr int kGenerations = 40, kBatch = 5;

// A repertoire that grows now and then and replaces now and then; all that it held at each row is remembered.
struct Told {
  std::vector<std::int64_t> held;                 // ids
  std::vector<std::vector<std::int64_t>> at_row;  // the same at each row of the progress
  std::vector<ProgressRow> progress;

  Told() {
    Rng rng(Seed(3));
    for (std::int64_t generation = 0; generation < kGenerations; ++generation) {
      for (int i = 0; i < kBatch; ++i) {
        const std::int64_t id = generation * kBatch + i;
        const double u = rng.uniform_double();
        if (held.empty() || u < 0.2)
          held.push_back(id);
        else if (u < 0.6)
          held[rng.below(static_cast<std::uint32_t>(held.size()))] = id;
      }
      if ((generation + 1) % 4 != 0) continue;
      at_row.push_back(held);
      progress.push_back({generation + 1, static_cast<std::int64_t>(held.size()), -1,
                          -2 + 0.01 * static_cast<double>(generation), (generation + 1) * kBatch});
    }
  }
  double replaced_after(std::size_t row) const {
    const auto gone = std::ranges::count_if(
        at_row[row], [&](std::int64_t id) { return std::ranges::find(held, id) == held.end(); });
    return static_cast<double>(gone) / static_cast<double>(at_row[row].size());
  }
  nlohmann::json collected(const std::string& name, const std::filesystem::path& path) const {
    Elites elites;
    elites.id = held;
    std::ranges::sort(elites.id);
    const auto n = static_cast<Eigen::Index>(held.size());
    elites.parent.assign(held.size(), -1);
    elites.solution = Rows::Constant(n, 3, 0.5f);
    elites.measures = Rows::Constant(n, 3, 0.5f);
    elites.objective = Eigen::VectorXf::Constant(n, -1);
    Hdf5Writer file(path);
    write_elites(file, elites, progress);
    file.close();
    return collect_statistics("tiny", {{name, path}});
  }
};

TEST(Replaced, IsWhatTheRepertoireWasTold) {
  TemporaryFolder folder;
  const Told told;
  for (const std::string name : {"layer3_n10", "flat_arcs"}) {
    const nlohmann::json found = told.collected(name + "/00.h5", folder.path() / "arcs.h5");
    const std::string prefix = name == "flat_arcs" ? name : "layer3.n10";
    const nlohmann::json& curve = found["curves"][prefix];
    ASSERT_EQ(curve["at"].size(), told.progress.size());
    for (std::size_t row = 0; row < told.progress.size(); ++row)
      EXPECT_NEAR(curve["replaced"]["median"][row].get<double>(), told.replaced_after(row), 1e-12) << row;
    EXPECT_NEAR(found["quantities"][prefix + ".replaced"]["median"].get<double>(), told.replaced_after(4),
                1e-12);
    EXPECT_GT(told.replaced_after(4), 0.2);
    EXPECT_NEAR(found["quantities"][prefix + ".late_gain"]["median"].get<double>(), 0.2, 1e-12);
  }
  const nlohmann::json lines = told.collected("layer2_n10/00.h5", folder.path() / "lines.h5");
  EXPECT_FALSE(lines["quantities"].contains("layer2.n10.replaced"));
  EXPECT_FALSE(lines["curves"]["layer2.n10"].contains("replaced"));
}

TEST(Replaced, RefusesACourseThatCannotBe) {
  TemporaryFolder folder;
  Told told;
  told.progress[6].size = 1;
  EXPECT_THROW(told.collected("flat_arcs/00.h5", folder.path() / "arcs.h5"), InputError);
}

}  // namespace
}  // namespace hbr
