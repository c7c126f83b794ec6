// The paper's own claims, reports/claims.toml.
#include "reports/claims/claims.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>

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

// Where two samples are said to differ, chance alone must not do: a test is asked for. Ranges in which
// samples that do not differ lie, and the hundreds of times of the sizes, need none.
TEST(PapersClaims, DifferencesAskForATest) {
  int asked = 0;
  for (const Claim& claim : read_claim_file(kPapersClaims).claims)
    for (const Check& check : claim.checks) {
      if (claim.decided_by != "result" || check.to.empty()) continue;
      const double no_effect = check.kind == "ratio" ? 1 : check.kind == "difference" ? 0 : 0.5;
      const bool differ = no_effect < check.reproduced[0] || no_effect > check.reproduced[1];
      if (!differ || claim.id == "size_ratio") continue;
      EXPECT_LT(check.p_below, 1) << claim.id << ": " << check.words;
      ++asked;
    }
  EXPECT_GT(asked, 15);
}

// The second sample of a comparison is the first, and numbers that say how far two differ say that they
// don't: no claim of an effect holds, not even in part.
TEST(PapersClaims, NoneOfAnEffectHoldsWithoutOne) {
  const std::set<std::string> of_sameness{"similar_coverage", "substitution_m1", "flat_arcs_blocked",
                                          "covering", "one_sample_best"};
  std::set<std::string> met;
  for (const Claim& claim : read_claim_file(kPapersClaims).claims) {
    if (claim.decided_by != "result") continue;
    std::map<std::string, double> middles;
    bool compares = false;
    for (const Check& check : claim.checks) {
      compares |= !check.to.empty();
      for (const std::string& name : {check.of, check.to})
        if (!name.empty()) middles.emplace(name, 1e9);
    }
    for (const Check& check : claim.checks)
      if (!check.to.empty()) middles[check.of] = middles[check.to] = 1;
    StatisticsTable table("test");
    for (const auto& [name, middle] : middles)
      for (int r = 0; r < 10; ++r) table.add(name, r, middle + 0.01 * r);
    if (!compares) continue;
    for (const json& one : evaluate_claims(kPapersClaims, table.json()))
      if (one["id"] == claim.id && one["indication"] != "not" && one["indication"] != "undecided")
        met.insert(claim.id);
  }
  EXPECT_EQ(met, of_sameness);
}

// What one claim counts no other counts again; a condition counts nothing.
TEST(PapersClaims, NoComparisonIsCountedTwice) {
  std::map<std::set<std::string>, std::string> asked_by;
  for (const Claim& claim : read_claim_file(kPapersClaims).claims) {
    if (claim.decided_by != "result") continue;
    for (const Check& check : claim.checks) {
      if (claim.id == "fooling" && check.p_below == 1) continue;
      const auto [at, anew] = asked_by.emplace(std::set{check.of, check.to}, claim.id);
      EXPECT_TRUE(anew || at->second == claim.id)
          << check.of << " and " << check.to << ": " << at->second << ", " << claim.id;
    }
  }
}

// A claim about a layer needs those below it at their size, too.
TEST(PapersClaims, LayersBelowCountAsWell) {
  const json claims = evaluate_claims(kPapersClaims, json::parse(std::ifstream(kSampleRun)));
  int stand_on_lines = 0;
  for (const json& claim : claims) {
    std::set<std::string> needs;
    for (const json& need : claim["needs"]) needs.insert(need["of"].get<std::string>());
    const bool substitution = claim["id"].get<std::string>().starts_with("substitution"),
               above = needs.contains("layer3.n10.generations") || needs.contains("layer3.b.generations");
    EXPECT_TRUE(!substitution || above) << claim["id"];
    if (!above) continue;
    EXPECT_TRUE(needs.contains("layer2.n10.generations")) << claim["id"];
    EXPECT_TRUE(needs.contains("layer1.generations")) << claim["id"];
    ++stand_on_lines;
  }
  EXPECT_GT(stand_on_lines, 10);
}

// Nobody is fooled where the flat digits are worse by the network's own error, too.
TEST(PapersClaims, FoolingAsksBothOpinions) {
  const auto verdict = [](double flat_error) {
    StatisticsTable table("test");
    for (int r = 0; r < 10; ++r) {
      const double shift = r * 1e-4;
      table.add("digit_verdicts.hbr.confidence", r, 0.8 + shift);
      table.add("digit_verdicts.flat.confidence", r, 0.3 + shift);
      table.add("digit_verdicts.hbr.distance", r, 0.8 + shift);
      table.add("digit_verdicts.flat.distance", r, 0.9 + shift);
      table.add("layer4.mean", r, -0.02 - shift);
      table.add("flat_digits.mean", r, flat_error - shift);
    }
    for (const json& claim : evaluate_claims(kPapersClaims, table.json()))
      if (claim["id"] == "fooling") return claim["indication"].get<std::string>();
    return std::string();
  };
  EXPECT_EQ(verdict(-0.015), "reproduced");
  EXPECT_EQ(verdict(-0.03), "partly");
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
