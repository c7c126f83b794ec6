#include "pipeline/statistics/statistics_file.h"

#include <gmock/gmock.h>

#include "pipeline/artifact/content.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/table.h"
#include "tests/support/damaged_json.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(StatisticsFile, TakesWhatRunsLeft) {
  EXPECT_NO_THROW(read_statistics(HBR_SOURCE_DIR "/tests/reports/fixtures/statistics.json"));
  for (const auto& entry : fs::directory_iterator(HBR_SOURCE_DIR "/reports/reference"))
    if (entry.is_directory()) {
      EXPECT_NO_THROW(read_statistics(entry.path() / "statistics.json"));
    }
}

TEST(StatisticsFile, RefusesWhatNoRunLeft) {
  StatisticsTable table("p");
  for (int r = 0; r < 3; ++r) {
    table.add("layer2.n10.size", r, 10 + r);
    table.add("layer2.n1.size", r, 12 + r);
  }
  table.test("layer2.n10.size", "layer2.n1.size");
  table.number("layer2.n10.generations", 5);
  table.box("substitution.m1.original", {1, 2, 3, 9});
  table.curve("layer4", "generation", {1, 2}, "size", {{1, 2}, {3, 4}});
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "statistics.json";
  write_file(file, table.json().dump());
  EXPECT_EQ(read_statistics(file), table.json());
  std::size_t refusals = 0;
  const std::vector<Damage> all = damages_of(table.json().dump());
  for (const auto& [what, text] : all) {
    write_file(file, text);
    try {
      read_statistics(file);
    } catch (const InputError& error) {
      ++refusals;
      EXPECT_THAT(error.what(), StartsWith(file.string() + ": ")) << what;
      EXPECT_THAT(error.what(), Not(HasSubstr("\n"))) << what;
    }
  }
  EXPECT_GT(refusals, all.size() * 8 / 10);  // the others are other numbers and other texts

  nlohmann::json twice = table.json();
  twice["quantities"]["layer2.n10.size"]["replications"] = {0, 1, 1};
  EXPECT_THROW(check_statistics(twice, "f"), InputError);
  nlohmann::json shorter = table.json();
  shorter["curves"]["layer4"]["size"]["median"] = {1};
  EXPECT_THROW(check_statistics(shorter, "f"), InputError);
}

}  // namespace
}  // namespace hbr
