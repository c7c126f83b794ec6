// The paper's own claims, reports/claims.toml.
#include "reports/claims/claims.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>

#include "pipeline/statistics/names.h"
#include "pipeline/statistics/table.h"
#include "reports/claims/claim_file.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using nlohmann::json;

const std::string kPapersClaims = std::string(HBR_SOURCE_DIR) + "/reports/claims.toml";
const std::string kSampleRun = std::string(HBR_SOURCE_DIR) + "/tests/reports/fixtures/statistics.json";

// A run in which x of the check is that.
json run_with(const Check& check, double x) {
  StatisticsTable table("test");
  for (int r = 0; r < 10; ++r) {
    const double shift = check.kind == "a12" ? r * 1e-3 : 0;
    const double to = check.kind == "difference" ? 0.25 : 1;
    const double of = check.kind == "ratio" ? x * to : check.kind == "difference" ? to + x : x;
    table.add(check.of, r, check.kind == "a12" ? (x > .5 ? 2 : 0) + shift : of);
    if (!check.to.empty()) table.add(check.to, r, to + shift);
  }
  return table.json();
}

// Of each check of the paper's claims that a result decides there is an outcome with which it does not hold:
// x is below its range or above it, and no share beyond [0, 1], no chance and no size below 0.
TEST(PapersClaims, CanFail) {
  TemporaryFolder folder;
  for (const Claim& claim : read_claim_file(kPapersClaims).claims) {
    if (claim.decided_by == "design") continue;
    EXPECT_FALSE(claim.checks.empty()) << claim.id;
    for (const Check& check : claim.checks) {
      const Meaning meaning = *meaning_of(check.of);
      const bool share =
          check.kind == "value" && meaning.unit.empty() && meaning.text.find("share") != std::string::npos;
      const double least = check.kind == "difference" || check.of.find("mean") != std::string::npos ||
                                   check.of.ends_with("confidence")
                               ? -1e9
                               : 0,
                   most = check.kind == "a12" || share ? 1 : 1e12;
      const double below = check.partly[0] - 1e-9 * std::max(1., std::abs(check.partly[0])),
                   above = check.partly[1] + 1e-9 * std::max(1., std::abs(check.partly[1]));
      const bool fails_below = below >= least, fails_above = above <= most;
      EXPECT_TRUE(fails_below || fails_above) << claim.id << ": " << check.words;
      const double x = check.kind == "a12" ? (fails_below ? 0 : 1) : fails_below ? below : above;
      const json all = evaluate_claims(kPapersClaims, run_with(check, x));
      const auto same =
          std::find_if(all.begin(), all.end(), [&](const json& one) { return one["id"] == claim.id; });
      const auto index = static_cast<std::size_t>(&check - claim.checks.data());
      EXPECT_EQ((*same)["checks"][index]["outcome"], "no") << claim.id << ": " << check.words;
    }
  }
}

// Nothing that a claim asks for is missing from a run of everything, such as the one that is kept of
// `reduced`.
TEST(PapersClaims, AreAllMeasuredByAWholeRun) {
  const std::string kept = std::string(HBR_SOURCE_DIR) + "/reports/reference/reduced/statistics.json";
  int checks = 0;
  for (const json& claim : evaluate_claims(kPapersClaims, json::parse(std::ifstream(kept))))
    for (const json& check : claim["checks"]) {
      EXPECT_NE(check["outcome"], "absent") << claim["id"] << ": " << check["ours"];
      ++checks;
    }
  EXPECT_GT(checks, 80);
}

TEST(PapersClaims, AreAllToldOfASample) {
  const json claims = evaluate_claims(kPapersClaims, json::parse(std::ifstream(kSampleRun)));
  EXPECT_GE(claims.size(), 40u);
  for (const json& claim : claims) {
    const std::string id = claim["id"];
    for (const char* key : {"place", "statement", "ours", "verdict", "reason"})
      EXPECT_FALSE(claim[key].get<std::string>().empty()) << id << " " << key;
    if (claim["needs"].empty())
      EXPECT_NE(claim["verdict"], "not at this size") << id << ": " << claim["reason"];
    else
      EXPECT_EQ(claim["verdict"], "not at this size") << id;
    for (const json& c : claim["checks"]) EXPECT_NE(c["outcome"], "absent") << id << ": " << c["ours"];
    const std::string quote = claim["quote"];
    EXPECT_LE(std::count(quote.begin(), quote.end(), ' '), 7) << id << ": a few words only";
  }
}

}  // namespace
}  // namespace hbr
