#include "reports/kept/verify.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "tests/reports/kept/kept_runs.h"

namespace hbr {
namespace {

using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

KeptRun elsewhere(KeptRun run = kept()) {
  run.toolchain["compiler"] = "GCC 13";
  return run;
}

json& values(KeptRun& run, const std::string& name) {
  return run.statistics[""]["quantities"][name]["values"];
}

TEST(Verify, ARunIsItself) {
  const Verification found = verify(kept(), kept());
  EXPECT_THAT(found.differences, IsEmpty());
  EXPECT_THAT(found.notes, IsEmpty());
  EXPECT_EQ(
      found.summary,
      "paper: 3 artifacts, 6 quantities and numbers and 2 claims compared with the reference bit for bit: no "
      "difference");
  EXPECT_THAT(verify(kept(), elsewhere()).differences, IsEmpty());
  EXPECT_THAT(verify(kept(), elsewhere()).notes,
              ElementsAre("another toolchain: compiler was 'GCC 12', is 'GCC 13'"));
}

TEST(Verify, TheSameToolchainPromisesEveryBit) {
  KeptRun run = kept();
  json& value = values(run, "accuracy.n10")[7];
  value = std::nextafter(value.get<double>(), std::numeric_limits<double>::infinity());
  const Verification found = verify(kept(), run);
  ASSERT_EQ(found.differences.size(), 1u);
  EXPECT_THAT(found.differences[0],
              HasSubstr("accuracy.n10: 1 of 50 replications differ; replication 7 was"));
  EXPECT_THAT(found.summary, HasSubstr("1 differences"));
  EXPECT_THAT(verify(kept(), elsewhere(run)).differences, IsEmpty());
  KeptRun mixed = run;
  mixed.toolchain = nullptr;
  EXPECT_THAT(verify(kept(), mixed).differences, IsEmpty());
  EXPECT_THAT(verify(kept(), mixed).notes[0], HasSubstr("this run was made by more than one toolchain"));

  run = kept();
  run.artifacts["layer1/01.h5"].bytes = "other";
  EXPECT_THAT(verify(kept(), run).differences,
              ElementsAre("layer1: 1 of 2 artifacts have other bytes (first layer1/01.h5)"));
  run.artifacts["layer1/00.h5"] = {"other", "other"};
  EXPECT_THAT(
      verify(kept(), run).differences,
      ElementsAre("layer1: 2 of 2 artifacts have other bytes (first layer1/00.h5); they were made with "
                  "other settings"));
  EXPECT_THAT(verify(kept(), elsewhere(run)).differences, IsEmpty());

  run = kept();
  run.statistics[""]["numbers"]["judge.test_accuracy"]["value"] = 0.991;
  EXPECT_THAT(verify(kept(), run).differences, ElementsAre("judge.test_accuracy: was 0.99, is 0.991"));
}

TEST(Verify, ElsewhereTheSameDistributionIsAskedFor) {
  int alarms = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    KeptRun run = elsewhere();
    values(run, "layer3.n10.mean") = normal(50, -5, 100 + seed);
    alarms += !verify(kept(), run).differences.empty();
  }
  EXPECT_LE(alarms, 6);  // 1 % of 200, shared by two quantities of which one is drawn again
  KeptRun run = elsewhere();
  values(run, "layer3.n10.mean") = normal(50, -4, 3);
  ASSERT_EQ(verify(kept(), run).differences.size(), 1u);
  EXPECT_THAT(verify(kept(), run).differences[0], HasSubstr("expected at least 0.005"));
}

// Four against four can't reach the level by ranks: their means are compared. Two tell nothing.
TEST(Verify, FewReplicationsAreComparedByTheirMeans) {
  KeptRun reference = kept(), run = elsewhere();
  const auto differs = [&](const std::vector<double>& was, const std::vector<double>& is) {
    reference.statistics[""]["quantities"]["accuracy.n10"] = quantity("m^2", was);
    run.statistics[""]["quantities"]["accuracy.n10"] = quantity("m^2", is);
    return !verify(reference, run).differences.empty();
  };
  // With a standard deviation of 1.291 in both and six degrees of freedom t is the difference over 0.9129; at
  // 1 % shared by two quantities it has to be less than 4.317.
  EXPECT_FALSE(differs({1, 2, 3, 4}, {4.93, 5.93, 6.93, 7.93}));
  EXPECT_TRUE(differs({1, 2, 3, 4}, {4.95, 5.95, 6.95, 7.95}));
  EXPECT_TRUE(differs({1, 1, 1}, {1.5, 1.5, 1.5}));
  EXPECT_FALSE(differs({1, 2}, {100, 101}));
  EXPECT_THAT(verify(reference, run).notes,
              Contains("1 quantities and numbers are of fewer than 3 replications, which tell nothing"));
  int alarms = 0;
  for (unsigned seed = 0; seed < 1000; ++seed)
    alarms += differs(normal(4, 0, seed), normal(4, 0, seed + 5000));
  EXPECT_LE(alarms, 12);  // 0.5 % of 1000
}

// What is counted by the outcome is no count of the settings; of two replications no number tells anything.
TEST(Verify, AsksForWhatCanBeTold) {
  KeptRun reference = kept(), run = elsewhere();
  const auto differences = [&] { return verify(reference, run).differences.size(); };
  for (KeptRun* each : {&reference, &run}) {
    const bool first = each == &reference;
    each->statistics[""]["quantities"]["layer4.covering_generations"] = quantity(
        "generations", first ? std::vector<double>{240, 200, 220} : std::vector<double>{190, 230, 240});
    each->statistics[""]["numbers"]["transfer.nao.absolute_outliers"] = hbr::number("%", first ? 3 : 9);
    each->statistics[""]["numbers"]["autoencoder.taken_for.1"] = hbr::number("class", first ? 6 : 2);
  }
  EXPECT_EQ(differences(), 1u);  // the share of outliers
  for (KeptRun* each : {&reference, &run})
    each->statistics[""]["quantities"]["transfer.nao.absolute"] = quantity("%", {2, 3});
  EXPECT_EQ(differences(), 0u);
  // Of ten that both have not the two of transfer, nor the class.
  EXPECT_THAT(verify(reference, run).summary, HasSubstr(" 7 quantities and numbers"));
  run.statistics[""]["quantities"]["layer3.n10.evaluations"]["values"][0] = 7;
  EXPECT_EQ(differences(), 1u);
}

// What has an interval may be anywhere in it.
TEST(Verify, IntervalsMustOverlap) {
  const auto with = [](KeptRun run, double low, double value, double high) {
    json& numbers = run.statistics[""]["numbers"];
    numbers["digit_turns.x"] = hbr::number("", value);
    numbers["digit_turns.x_low"] = hbr::number("", low);
    numbers["digit_turns.x_high"] = hbr::number("", high);
    return run;
  };
  const KeptRun reference = with(kept(), 0.4, 0.5, 0.6);
  EXPECT_THAT(verify(reference, with(elsewhere(), 0.58, 0.68, 0.78)).differences, IsEmpty());
  const auto apart = verify(reference, with(elsewhere(), 0.62, 0.68, 0.78)).differences;
  ASSERT_EQ(apart.size(), 1u);
  EXPECT_THAT(apart[0],
              HasSubstr("was 0.5 [0.4; 0.6], is 0.68 [0.62; 0.78]; expected intervals that overlap"));
  EXPECT_EQ(verify(reference, with(kept(), 0.58, 0.68, 0.78)).differences.size(), 3u);  // bit for bit
  // Whiskers, which are of no number, are compared themselves.
  const auto whiskers = [](KeptRun run, double high) {
    run.statistics[""]["numbers"]["transfer.nao.absolute_low"] = hbr::number("%", 0.1);
    run.statistics[""]["numbers"]["transfer.nao.absolute_high"] = hbr::number("%", high);
    return run;
  };
  EXPECT_EQ(verify(whiskers(kept(), 6), whiskers(elsewhere(), 9)).differences.size(), 1u);
}

TEST(Verify, CountsAreExactAndNumbersWithinReach) {
  KeptRun run = elsewhere();
  values(run, "layer3.n10.evaluations")[3] = 2e6 + 1;
  EXPECT_EQ(verify(kept(), run).differences.size(), 1u);
  const auto number = [](const std::string& name, double value) {
    KeptRun other = elsewhere();
    other.statistics[""]["numbers"][name]["value"] = value;
    return verify(kept(), other).differences.size();
  };
  EXPECT_EQ(number("layer3.n10.generations", 10001), 1u);
  EXPECT_EQ(number("judge.test_accuracy", 0.975), 0u);
  EXPECT_EQ(number("judge.test_accuracy", 0.965), 1u);
  EXPECT_EQ(number("pooled.layer2_size", 1530), 0u);
  EXPECT_EQ(number("pooled.layer2_size", 1550), 1u);
}

TEST(Verify, WhatOnlyOneHasIsSaid) {
  KeptRun reference = kept(), run = kept();
  run.statistics[""]["quantities"]["digit_verdicts.hbr.good"] = quantity("", {0.5});
  run.statistics[""]["quantities"]["digit_verdicts.flat.good"] = quantity("", {0.5});
  EXPECT_THAT(verify(reference, run).differences, IsEmpty());
  EXPECT_THAT(
      verify(reference, run).notes,
      ElementsAre("digit_verdicts: 2 quantities of this run are not in the reference and not compared "
                  "(digit_verdicts.flat.good, ...)"));
  EXPECT_THAT(verify(run, reference).differences, IsEmpty());
  EXPECT_THAT(
      verify(run, reference).notes,
      ElementsAre(
          "digit_verdicts: this run has nothing of it; 2 quantities of the reference are not compared"));
  // One of a kind that is there must be there.
  run = kept();
  run.statistics[""]["quantities"].erase("layer3.n10.mean");
  EXPECT_THAT(verify(reference, run).differences,
              ElementsAre("layer3.n10.mean: in the reference, but not in this run"));

  run = kept();
  for (const char* name : {"layer3.n10.mean", "accuracy.n10"})
    run.statistics[""]["quantities"][name] =
        quantity("", {values(reference, name)[0], values(reference, name)[1]});
  EXPECT_THAT(verify(reference, run).differences, IsEmpty());
  EXPECT_THAT(
      verify(reference, run).notes,
      ElementsAre("2 of the quantities have 2 replications here and 50 in the reference; those that both "
                  "have are compared"));
}

TEST(Verify, NothingComparedIsADifference) {
  KeptRun run = elsewhere();
  for (const char* list : {"quantities", "numbers"}) run.statistics[""][list] = json::object();
  run.claims = json::array();
  EXPECT_THAT(verify(kept(), run).differences, ElementsAre(HasSubstr("nothing could be compared")));
}

TEST(Verify, VariationsAreComparedLikeTheRun) {
  KeptRun reference = kept(), run = kept();
  reference.statistics["short"] = run.statistics["short"] = run.statistics[""];
  EXPECT_THAT(verify(reference, run).summary, HasSubstr(" 12 quantities"));
  run.statistics["short"]["numbers"]["pooled.layer2_size"]["value"] = 1401;
  EXPECT_THAT(verify(reference, run).differences,
              ElementsAre("short: pooled.layer2_size: was 1400, is 1401"));
  EXPECT_THAT(verify(kept(), run).notes, ElementsAre("variation short: not in the reference, not compared"));
  EXPECT_THAT(verify(reference, kept()).notes, ElementsAre("variation short: not in this run, not compared"));
}

TEST(Verify, VerdictsAreComparedByWhatBothCanSay) {
  KeptRun run = kept();
  run.claims[0]["verdict"] = "not at this size";  // points to the same
  EXPECT_THAT(verify(kept(), run).differences, IsEmpty());
  run.claims[0]["indication"] = "partly";
  EXPECT_THAT(verify(kept(), run).differences,
              ElementsAre("claim a: was 'reproduced' (2.1), is 'partly' (2.1)"));
  EXPECT_THAT(verify(kept(), elsewhere(run)).differences, IsEmpty());
  EXPECT_THAT(verify(kept(), elsewhere(run)).notes, Contains(HasSubstr("claim a: was 'reproduced'")));
  run.claims.erase(0);
  EXPECT_THAT(verify(kept(), run).notes, ElementsAre("claim a: no claim of this run"));
}

}  // namespace
}  // namespace hbr
