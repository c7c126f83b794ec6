// Verdicts of claims whose tests are read together, and how sure their effects are.
#include <gmock/gmock.h>

#include <fstream>

#include "pipeline/statistics/rank_sum.h"
#include "pipeline/statistics/table.h"
#include "reports/claims/claims.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using nlohmann::json;

// So many claims, each that the lines' errors of N = 1 are greater than those of N = 10.
std::filesystem::path claims(const TemporaryFolder& folder, int count) {
  const std::filesystem::path path = folder.path() / "claims.toml";
  std::ofstream file(path);
  file << "sizes = []\n";
  for (int i = 0; i < count; ++i)
    file << "[[claims]]\nid = \"c" << i
         << "\"\nplace = \"\"\nstatement = \"\"\nquote = \"\"\npaper = \"\"\nsize = \"\"\ndecided_by = "
            "\"result\"\nchecks = [{ words = \"w\", kind = \"a12\", of = \"accuracy.n1\", to = "
            "\"accuracy.n10\", reproduced = [0.6], partly = [0.5], p_below = 0.05 }]\n";
  return path;
}

// Ten against ten values, one of each exchanged.
json errors() {
  StatisticsTable table("test");
  for (int r = 0; r < 10; ++r) {
    table.add("accuracy.n1", r, r < 1 ? r : 12 + r);
    table.add("accuracy.n10", r, r < 1 ? 30 + r : 3.5 + r);
  }
  return table.json();
}

TEST(ClaimsReadTogether, NeedMoreEvidenceTheMoreTheyAre) {
  TemporaryFolder folder;
  const json statistics = errors();
  const double alone = evaluate_claims(claims(folder, 1), statistics)[0]["checks"][0]["p"];
  ASSERT_GT(alone, 0.05 / 12);
  ASSERT_LT(alone, 0.05);
  for (const int count : {1, 2, 12}) {
    const json all = evaluate_claims(claims(folder, count), statistics);
    for (const json& claim : all) {
      const json& check = claim["checks"][0];
      EXPECT_DOUBLE_EQ(check["p_alone"].get<double>(), alone);
      EXPECT_DOUBLE_EQ(check["p"].get<double>(), std::min(1.0, count * alone));
      EXPECT_EQ(claim["verdict"], count * alone < 0.05 ? "reproduced" : "undecided") << count;
      // (2.865 + 0.842)^2 / (6 * 0.31^2) = 23.8 of each at a twelfth of the level, with an A12 of 0.81.
      EXPECT_EQ(check.contains("would_tell"), count == 12);
      if (count == 12) {
        EXPECT_EQ(check["would_tell"], 24);
        EXPECT_THAT(check["ours"].get<std::string>(), testing::HasSubstr("n = 10 (about 24 might tell)"));
      }
    }
  }
}

TEST(ClaimsReadTogether, TellHowSureTheEffectIs) {
  TemporaryFolder folder;
  const json check = evaluate_claims(claims(folder, 1), errors())[0]["checks"][0];
  const double low = check["interval"][0], high = check["interval"][1], x = check["x"];
  EXPECT_LT(low, x);
  EXPECT_GT(high, x);
  EXPECT_GE(low, 0);
  EXPECT_LE(high, 1);
  EXPECT_THAT(check["ours"].get<std::string>(), testing::HasSubstr("A12 = "));
  EXPECT_THAT(check["ours"].get<std::string>(), testing::ContainsRegex("\\[0\\.[0-9]+; [01]"));
}

}  // namespace
}  // namespace hbr
