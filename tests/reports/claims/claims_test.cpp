#include "reports/claims/claims.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "pipeline/core/check.h"
#include "pipeline/statistics/table.h"
#include "reports/claims/claim_file.h"
#include "reports/claims/claims_table.h"
#include "reports/claims/verdicts.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using nlohmann::json;
using testing::HasSubstr;

const std::string kClaims = std::string(HBR_SOURCE_DIR) + "/reports/claims.toml";

// A file with one claim about accuracies; `checks` are lines of TOML.
std::filesystem::path claim_file(const TemporaryFolder& folder, const std::string& checks,
                                 const std::string& size = "") {
  const std::filesystem::path path = folder.path() / "claims.toml";
  std::ofstream(path) << "[[sizes]]\nname = \"full\"\nneeds = [{ of = \"accuracy.n1\", at_least = 50 }, "
                         "{ of = \"layer2.n1.generations\", at_least = 10000 }]\n"
                         "[[claims]]\nid = \"one\"\nplace = \"5.3\"\nstatement = \"so\"\nquote = \"\"\n"
                         "paper = \"2\"\nsize = \""
                      << size << "\"\ndecided_by = \"result\"\nchecks = [" << checks << "]\n";
  return path;
}

std::string check(const std::string& kind, const std::string& of, const std::string& to,
                  const std::string& reproduced, const std::string& partly,
                  const std::string& p_below = "1") {
  return fmt::format(
      "{{ words = \"w\", kind = \"{}\", of = \"{}\", to = \"{}\", reproduced = {}, partly = {}, "
      "p_below = {} }},",
      kind, of, to, reproduced, partly, p_below);
}

// accuracy.n1 is 10 + r / n, accuracy.n10 4 + r / n, over n replications.
json accuracies(int n, double generations = 10000) {
  StatisticsTable table("test");
  for (int r = 0; r < n; ++r) {
    table.add("accuracy.n1", r, 10 + r / static_cast<double>(n));
    table.add("accuracy.n10", r, 4 + r / static_cast<double>(n));
  }
  table.number("layer2.n1.generations", generations);
  return table.json();
}

json evaluate_one(const std::filesystem::path& path, const json& statistics) {
  const json claims = evaluate_claims(path, statistics);
  EXPECT_EQ(claims.size(), 1u);
  return claims.at(0);
}

std::string failure(const std::filesystem::path& path) {
  try {
    evaluate_claims(path, accuracies(3));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Claims, EveryKindOfCheckByHand) {
  TemporaryFolder folder;
  const json statistics = accuracies(5);  // medians 10.4 and 4.4
  struct Case {
    std::string kind, to;
    double x;
    std::string figure;  // spaces within a number's unit are narrow ones
  };
  for (const Case& c :
       {Case{"value", "", 10.4, "10.4\u202fm²"}, Case{"ratio", "accuracy.n10", 10.4 / 4.4, "2.36 times"},
        Case{"difference", "accuracy.n10", 6, "6\u202fm²"}, Case{"a12", "accuracy.n10", 1, "A12 1"}}) {
    const auto verdict = [&](double low, double high, double partly_low, double partly_high) {
      const json claim = evaluate_one(
          claim_file(folder, check(c.kind, "accuracy.n1", c.to, fmt::format("[{}, {}]", low, high),
                                   fmt::format("[{}, {}]", partly_low, partly_high))),
          statistics);
      EXPECT_NEAR(claim["checks"][0]["x"].get<double>(), c.x, 1e-12);
      EXPECT_EQ(claim["checks"][0]["figure"], c.figure);
      EXPECT_EQ(claim["verdict"], claim["indication"]);
      return claim["verdict"].get<std::string>();
    };
    EXPECT_EQ(verdict(c.x - 0.1, c.x + 0.1, c.x - 1, c.x + 1), "reproduced") << c.kind;
    EXPECT_EQ(verdict(c.x + 0.1, c.x + 0.2, c.x - 1, c.x + 1), "partly") << c.kind;
    EXPECT_EQ(verdict(c.x + 0.1, c.x + 0.2, c.x + 0.05, c.x + 1), "not") << c.kind;
  }
}

TEST(Claims, SignificanceIsAskedForBesides) {
  TemporaryFolder folder;
  const auto file =
      claim_file(folder, check("ratio", "accuracy.n1", "accuracy.n10", "[2]", "[1]", "7.1e-18"), "full");
  const json full = evaluate_one(file, accuracies(50));
  EXPECT_EQ(full["verdict"], "reproduced");
  EXPECT_NEAR(full["checks"][0]["p"].get<double>(), 7.066e-18, 1e-21);
  EXPECT_TRUE(full["checks"][0]["reproduced"][1].is_null());

  // Overlapping samples: the ratio holds, the test does not.
  json overlapping = accuracies(50);
  for (int r = 0; r < 2; ++r) overlapping["quantities"]["accuracy.n1"]["values"][r] = 0;
  EXPECT_EQ(evaluate_one(file, overlapping)["verdict"], "partly");
}

TEST(Claims, TheFloorOfTheTestIsReachedByCompleteSeparationOnly) {
  TemporaryFolder folder;
  const auto file =
      claim_file(folder, check("ratio", "accuracy.n1", "accuracy.n10", "[2]", "[1]", "7.1e-18"));
  EXPECT_EQ(evaluate_one(file, accuracies(5))["verdict"], "reproduced");
  json overlapping = accuracies(5);
  overlapping["quantities"]["accuracy.n1"]["values"][0] = 0;
  EXPECT_EQ(evaluate_one(file, overlapping)["verdict"], "undecided");
}

// What a test does not tell from chance holds not even in part, and three replications can't tell anything.
TEST(Claims, WhatChanceMayDoIsUndecided) {
  TemporaryFolder folder;
  const std::string asked = check("ratio", "accuracy.n1", "accuracy.n10", "[2]", "[1]", "0.05"),
                    in_part = check("ratio", "accuracy.n1", "accuracy.n10", "[3]", "[1]", "0.05"),
                    fails = check("ratio", "accuracy.n1", "accuracy.n10", "[9]", "[8]", "0.05"),
                    untested = check("value", "accuracy.n1", "", "[0]", "[0]");
  const auto verdict = [&](const std::string& checks, const json& statistics) {
    return evaluate_one(claim_file(folder, checks), statistics)["verdict"].get<std::string>();
  };
  for (const int n : {1, 2, 3}) {
    EXPECT_EQ(verdict(asked, accuracies(n)), "undecided") << n;
    EXPECT_EQ(verdict(in_part, accuracies(n)), "undecided") << n;
    EXPECT_EQ(verdict(fails, accuracies(n)), "not") << n;
  }
  EXPECT_EQ(verdict(asked, accuracies(5)), "reproduced");
  EXPECT_EQ(verdict(in_part, accuracies(5)), "partly");
  EXPECT_EQ(verdict(asked + fails, accuracies(2)), "not");  // one fails, and for the other nothing speaks
  EXPECT_EQ(verdict(asked + asked, accuracies(2)), "undecided");
  EXPECT_EQ(verdict(asked + untested, accuracies(2)), "partly");
  const json claim = evaluate_one(claim_file(folder, asked), accuracies(2));
  EXPECT_EQ(claim["checks"][0]["outcome"], "undecided");
  EXPECT_EQ(claim["reason"], "0 of 1 check holds, 1 is not told from chance.");
  EXPECT_THAT(verdict_tiles(json::array({claim})), HasSubstr("<b>1</b><span>?&nbsp;undecided"));
  EXPECT_THAT(claims_table(json::array({claim})), HasSubstr("? not told from chance"));
}

// Where an effect is claimed, what equal samples meet as well can fail and is no evidence; alone it is the
// claim.
TEST(Claims, WhatNoEffectMeetsIsACondition) {
  TemporaryFolder folder;
  const std::string effect = check("a12", "accuracy.n1", "accuracy.n10", "[0.71, 1]", "[0.56, 1]", "0.05"),
                    same = check("ratio", "layer2.n1.size", "layer2.n10.size", "[0.8, 1.25]", "[0.5, 2]");
  const auto verdict = [&](const std::string& checks, bool differ, double size) {
    StatisticsTable table("test");
    for (int r = 0; r < 10; ++r) {
      table.add("accuracy.n1", r, r + (differ ? 20 : 0));
      table.add("accuracy.n10", r, r);
      table.add("layer2.n1.size", r, size);
      table.add("layer2.n10.size", r, 1);
    }
    return evaluate_one(claim_file(folder, checks), table.json())["verdict"].get<std::string>();
  };
  EXPECT_EQ(verdict(effect + same, true, 1), "reproduced");
  EXPECT_EQ(verdict(effect + same, true, 9), "partly");
  EXPECT_EQ(verdict(effect + same, false, 1), "not");
  EXPECT_EQ(verdict(same, false, 1), "reproduced");
  EXPECT_EQ(verdict(same, false, 1.5), "partly");
}

// Two against two give a p of 1/3 at least: none is told, and what is told says between what and of how many.
TEST(Claims, EachCheckSaysWhatIsComparedAndNoPOfTwo) {
  TemporaryFolder folder;
  const auto file = claim_file(folder, check("ratio", "accuracy.n1", "accuracy.n10", "[2]", "[1]", "0.05"));
  const json two = evaluate_one(file, accuracies(2))["checks"][0],
             three = evaluate_one(file, accuracies(3))["checks"][0];
  EXPECT_EQ(two["ours"], "2.41 times (10.2\u202fm² against 4.25\u202fm²), n = 2 (about 6 might tell)");
  EXPECT_FALSE(two.contains("p"));
  EXPECT_EQ(three["ours"],
            "2.38 times [2.14; 2.67] (10.3\u202fm² against 4.33\u202fm², p = 0.10, the least for so few), n "
            "= 3 (about 6 might tell)");
  EXPECT_NEAR(three["p"].get<double>(), 2 / 20.0, 1e-12);
  EXPECT_EQ(three["asked"], "at least 2 times and p < 0.05");
}

TEST(Claims, TheEndsOfARangeBelongToIt) {
  TemporaryFolder folder;
  const json statistics = accuracies(2, 500);  // median 10.25
  for (const char* range : {"[10.25, 11]", "[10, 10.25]"})
    EXPECT_EQ(evaluate_one(claim_file(folder, check("value", "accuracy.n1", "", range, "[0]")),
                           statistics)["verdict"],
              "reproduced");
}

TEST(Claims, ASmallRunIsNotDecidedButIndicates) {
  TemporaryFolder folder;
  const auto file =
      claim_file(folder, check("ratio", "accuracy.n1", "accuracy.n10", "[2]", "[1]", "7.1e-18"), "full");
  const json few = evaluate_one(file, accuracies(5, 500));
  EXPECT_EQ(few["verdict"], "not at this size");
  EXPECT_EQ(few["indication"], "reproduced");  // complete separation is all that five can show
  EXPECT_THAT(few["reason"].get<std::string>(), HasSubstr("50 replications (this run: 5)"));
  EXPECT_THAT(few["reason"].get<std::string>(), HasSubstr("generations (this run: 500)"));
  EXPECT_FALSE(few["needs"][0]["met"]);
  EXPECT_EQ(few["needs"][0]["found"], 5);

  const json short_run = evaluate_one(file, accuracies(50, 500));
  EXPECT_EQ(short_run["verdict"], "not at this size");
  EXPECT_TRUE(short_run["needs"][0]["met"]);
  EXPECT_FALSE(short_run["needs"][1]["met"]);
}

TEST(Claims, WhatIsAbsentIsNotDecided) {
  TemporaryFolder folder;
  const json claim =
      evaluate_one(claim_file(folder, check("value", "accuracy.n1", "", "[0]", "[0]") +
                                          check("ratio", "accuracy.n1", "accuracy.n100", "[1]", "[1]")),
                   accuracies(3));
  EXPECT_EQ(claim["verdict"], "not at this size");
  EXPECT_EQ(claim["indication"], "reproduced");
  EXPECT_EQ(claim["checks"][1]["outcome"], "absent");
  EXPECT_EQ(claim["checks"][1]["ours"], "this run has no accuracy.n100");
  EXPECT_EQ(claim["reason"], "1 of 2 checks hold, 1 could not be measured.");
}

TEST(Claims, SomeChecksMakeAPart) {
  TemporaryFolder folder;
  const std::string holds = check("value", "accuracy.n1", "", "[0]", "[0]");
  const std::string fails = check("value", "accuracy.n1", "", "[0, 1]", "[0, 1]");
  EXPECT_EQ(evaluate_one(claim_file(folder, holds + fails), accuracies(3))["verdict"], "partly");
  EXPECT_EQ(evaluate_one(claim_file(folder, fails + fails), accuracies(3))["verdict"], "not");
  EXPECT_EQ(evaluate_one(claim_file(folder, holds + holds), accuracies(3))["verdict"], "reproduced");
}

TEST(Claims, SizeAloneCanBeTheClaim) {
  TemporaryFolder folder;
  EXPECT_EQ(evaluate_one(claim_file(folder, "", "full"), accuracies(50))["verdict"], "reproduced");
  const json few = evaluate_one(claim_file(folder, "", "full"), accuracies(3));
  EXPECT_EQ(few["verdict"], "not at this size");
  EXPECT_EQ(few["indication"], "");
}

TEST(Claims, TheFileIsReadStrictly) {
  TemporaryFolder folder;
  const std::string good = check("value", "accuracy.n1", "", "[0, 1]", "[0, 1]");
  EXPECT_EQ(failure(claim_file(folder, good)), "no error");
  EXPECT_THAT(failure(claim_file(folder, check("value", "acuracy.n1", "", "[0, 1]", "[0, 1]"))),
              HasSubstr("no statistic can be called 'acuracy.n1'"));
  EXPECT_THAT(failure(claim_file(folder, check("value", "layer2.n10.sizes", "", "[0, 1]", "[0, 1]"))),
              HasSubstr("layer2.n10.sizes"));
  EXPECT_THAT(failure(claim_file(folder, check("values", "accuracy.n1", "", "[0, 1]", "[0, 1]"))),
              HasSubstr("kind"));
  EXPECT_THAT(failure(claim_file(folder, check("ratio", "accuracy.n1", "", "[0, 1]", "[0, 1]"))),
              HasSubstr("'to'"));
  EXPECT_THAT(failure(claim_file(folder, check("value", "accuracy.n1", "", "[1, 0]", "[0, 1]"))),
              HasSubstr("[low, high] or"));
  EXPECT_THAT(failure(claim_file(folder, check("value", "accuracy.n1", "", "[]", "[0, 1]"))),
              HasSubstr("[low, high] or"));
  EXPECT_THAT(failure(claim_file(folder, check("value", "accuracy.n1", "", "[0, 2]", "[0, 1]"))),
              HasSubstr("contain"));
  EXPECT_THAT(failure(claim_file(folder, check("value", "accuracy.n1", "", "[0, 2]", "[0, 2]", "0.05"))),
              HasSubstr("p_below"));
  EXPECT_THAT(failure(claim_file(folder, good, "ful")), HasSubstr("did you mean 'full'"));
  EXPECT_THAT(failure(claim_file(folder, "")), HasSubstr("neither checks nor a size"));
  EXPECT_THAT(failure(claim_file(folder, "{ word = \"w\" }")), HasSubstr("unknown key"));
  EXPECT_THAT(failure(folder.path() / "nowhere.toml"), HasSubstr("nowhere.toml"));
  EXPECT_THROW(evaluate_claims(kClaims, json::object()), InputError);
}

// What the settings decide, and what the paper does not say, is shown, but not counted.
TEST(Claims, OfTheDesignAndOursAreNotCounted) {
  TemporaryFolder folder;
  const auto file = claim_file(folder, check("value", "accuracy.n1", "", "[0]", "[0]"));
  std::stringstream whole;
  whole << std::ifstream(file).rdbuf();
  std::string text = whole.str();
  text.replace(text.find("\"result\""), 8, "\"design\"");
  std::ofstream(file) << text;
  const json design = evaluate_claims(file, accuracies(3));
  EXPECT_EQ(design[0]["verdict"], "reproduced");
  EXPECT_THAT(verdict_tiles(design), HasSubstr("<b>0</b><span>✓&nbsp;reproduced"));
  EXPECT_THAT(claims_table(design), HasSubstr("Facts of the design"));
  text.replace(text.find("\"design\""), 8, "\"ours\"");
  std::ofstream(file) << text;
  const json ours = evaluate_claims(file, accuracies(3));
  EXPECT_THAT(verdict_tiles(ours), HasSubstr("<b>0</b><span>✓&nbsp;reproduced"));
  EXPECT_THAT(claims_table(ours), HasSubstr("What we ask besides"));
  text.replace(text.find("\"ours\""), 6, "\"result\"");
  std::ofstream(file) << text;
  const json result = evaluate_claims(file, accuracies(3));
  EXPECT_THAT(verdict_tiles(result), HasSubstr("<b>1</b><span>✓&nbsp;reproduced"));
  EXPECT_THAT(claims_table(result), Not(HasSubstr("Facts of the design")));
}

}  // namespace
}  // namespace hbr
