#include "reports/verify.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <random>

#include "pipeline/artifact/freshness.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/summary.h"
#include "tests/support/damaged_json.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const json kToolchain = {{"compiler", "GCC 12"},
                         {"flags", "-O3"},
                         {"architecture", "x86-64-v3"},
                         {"processor", "x86-64-v3"},
                         {"libraries", "glibc 2.36"}};

json quantity(const std::string& unit, const std::vector<double>& values) {
  json replications = json::array();
  for (std::size_t i = 0; i < values.size(); ++i) replications.push_back(i);
  const Summary s = summarise(values, "");
  return {{"unit", unit},       {"meaning", "what it is"}, {"values", values}, {"replications", replications},
          {"n", values.size()}, {"median", s.median},      {"q1", s.q1},       {"q3", s.q3},
          {"min", s.minimum},   {"max", s.maximum}};
}

json number(const std::string& unit, double value) {
  return {{"unit", unit}, {"meaning", "what it is"}, {"value", value}};
}

std::vector<double> normal(int n, double mean, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> draw(mean, 1);
  std::vector<double> values;
  for (int i = 0; i < n; ++i) values.push_back(draw(random));
  return values;
}

KeptRun kept() {
  KeptRun run;
  run.profile = "paper";
  run.toolchain = kToolchain;
  run.versions = {"v1"};
  run.statistics[""] = {{"quantities",
                         {{"layer3.n10.mean", quantity("fitness", normal(50, -5, 1))},
                          {"layer3.n10.evaluations", quantity("evaluations", std::vector<double>(50, 2e6))},
                          {"accuracy.n10", quantity("m^2", normal(50, 9, 2))}}},
                        {"numbers",
                         {{"layer3.n10.generations", number("generations", 10000)},
                          {"judge.test_accuracy", number("", 0.99)},
                          {"pooled.layer2_size", number("elites", 1400)}}},
                        {"profile", "paper"},
                        {"tests", json::object()},
                        {"boxes", json::object()}};
  run.claims = json::parse(
      R"([{"id": "a", "paper": "2", "ours": "2.1", "verdict": "reproduced", "indication": "reproduced"},
          {"id": "b", "paper": "1", "ours": "–", "verdict": "not at this size", "indication": "partly"},
          {"id": "c", "paper": "1", "ours": "–", "verdict": "not at this size", "indication": ""}])");
  run.artifacts = {{"layer1/00.h5", {std::string(16, '1'), std::string(16, 'a')}},
                   {"layer1/01.h5", {std::string(16, '2'), std::string(16, 'b')}},
                   {"judge.h5", {std::string(16, '3'), std::string(16, 'c')}}};
  return run;
}

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

// Four against four can't reach the level: the median must lie within the fences.
TEST(Verify, FewReplicationsMustLieWithinTheFences) {
  KeptRun reference = kept(), run = elsewhere();
  reference.statistics[""]["quantities"]["accuracy.n10"] = quantity("m^2", {1, 2, 3, 4});  // 1.75 and 3.25
  for (const auto& [median, differs] :
       {std::pair{5.5, false}, std::pair{5.51, true}, std::pair{-0.49, false}, std::pair{-0.51, true}}) {
    run.statistics[""]["quantities"]["accuracy.n10"] = quantity("m^2", {median, median, median});
    EXPECT_EQ(verify(reference, run).differences.size(), differs ? 1u : 0u) << median;
  }
  EXPECT_THAT(verify(reference, run).differences[0], HasSubstr("expected -0.5 to 5.5"));
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
  run.statistics[""]["quantities"]["digits.hbr.good"] = quantity("", {0.5});
  run.statistics[""]["quantities"]["digits.flat.good"] = quantity("", {0.5});
  EXPECT_THAT(verify(reference, run).differences, IsEmpty());
  EXPECT_THAT(verify(reference, run).notes,
              ElementsAre("digits: 2 quantities of this run are not in the reference and not compared "
                          "(digits.flat.good, ...)"));
  EXPECT_THAT(verify(run, reference).differences, IsEmpty());
  EXPECT_THAT(
      verify(run, reference).notes,
      ElementsAre("digits: this run has nothing of it; 2 quantities of the reference are not compared"));
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

class KeptRuns : public testing::Test {
 protected:
  KeptRuns() {
    std::ofstream(made("layer1/00.h5")) << "bytes";
    manifest("layer1/00.h5", {});
    std::ofstream(made("statistics.json"))
        << R"({"profile": "p", "quantities": {}, "numbers": {}, "tests": {}, "boxes": {},
               "curves": {"layer1": {"x": "generation", "at": [], "n": 1}}})";
    manifest("statistics.json", {"layer1/00.h5"});
    fs::create_directories(out() / "page");
    std::ofstream(out() / "page/claims.json")
        << R"([{"id": "a", "paper": "", "ours": "", "verdict": "not", "indication": "not", "reason": "r"}])";
    manifest("page", {"layer1/00.h5", "statistics.json"});
  }
  fs::path out() const { return folder_.path() / "out"; }
  fs::path made(const std::string& output) const {
    fs::create_directories((out() / output).parent_path());
    return out() / output;
  }
  void manifest(const std::string& output, const std::vector<std::string>& inputs) const {
    Node node;
    node.output = output;
    node.settings = {{"x", 1}};
    Manifest m;
    for (const std::string& input : inputs) {
      node.inputs.emplace_back(input, input);
      m.made_from.inputs[input] = content_of(out() / input).sha256;
    }
    m.made_from.slice = slice_of(node);
    m.key = m.made_from.key();
    m.content = content_of(out() / output);
    m.sign = sign_of(out() / output);
    m.run = kToolchain;
    m.run["version"] = "v1";
    write_manifest(manifest_path(out(), node), m);
  }
  std::string complaint() const {
    try {
      read_run(out());
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  }
  TemporaryFolder folder_;
};

TEST_F(KeptRuns, ComeBackAsTheyWere) {
  const KeptRun run = read_run(out());
  EXPECT_EQ(run.profile, "p");
  EXPECT_EQ(run.toolchain, kToolchain);
  EXPECT_EQ(run.artifacts.size(), 1u);
  EXPECT_EQ(run.artifacts.at("layer1/00.h5").bytes, sha256_of_text("bytes").substr(0, 16));
  EXPECT_FALSE(run.statistics.at("").contains("curves"));
  KeptRun more = kept();
  more.statistics["short"] = more.statistics[""];
  for (const KeptRun& each : {run, more}) {
    write_kept(each, folder_.path() / "kept");
    const KeptRun again = read_kept(folder_.path() / "kept");
    EXPECT_EQ(again.profile, each.profile);
    EXPECT_EQ(again.toolchain, each.toolchain);
    EXPECT_EQ(again.versions, each.versions);
    EXPECT_EQ(again.statistics, each.statistics);
    EXPECT_EQ(again.claims, each.claims);
    EXPECT_EQ(again.artifacts, each.artifacts);
  }
  write_kept(kept(), folder_.path() / "kept");
  EXPECT_EQ(read_kept(folder_.path() / "kept").statistics.size(), 1u);  // the variation's is gone
  EXPECT_THROW(read_kept(folder_.path() / "none"), InputError);
  // Damaged in any place it is refused in one line, or can be compared.
  for (const char* name : {"origin.json", "claims.json", "statistics.json"}) {
    const fs::path file = folder_.path() / "kept" / name;
    const std::string good = read_whole(file);
    std::size_t refusals = 0;
    const std::vector<Damage> all = damages_of(good);
    for (const auto& [what, text] : all) {
      write_file(file, text);
      try {
        verify(read_kept(folder_.path() / "kept"), kept());
      } catch (const InputError& error) {
        ++refusals;
        EXPECT_THAT(error.what(), testing::StartsWith(file.string())) << what;
        EXPECT_THAT(error.what(), Not(HasSubstr("\n"))) << what;
      }
    }
    EXPECT_GT(refusals, all.size() / 2) << name;
    write_file(file, good);
  }
  fs::remove(folder_.path() / "kept/claims.json");
  EXPECT_THROW(read_kept(folder_.path() / "kept"), InputError);
}

TEST_F(KeptRuns, TheListOfArtifactsIsReadStrictly) {
  write_kept(kept(), folder_.path() / "kept");
  const fs::path file = folder_.path() / "kept/artifacts.csv";
  const std::string good = read_whole(file), line = "a.h5,0123456789abcdef,0123456789abcdef\n";
  write_file(file, good + line);
  EXPECT_EQ(read_kept(folder_.path() / "kept").artifacts.size(), 4u);
  for (const std::string& wrong :
       {std::string(), "x" + good, good + "\n", good + "a.h5\n", good + line + line, good + "a.h5,,\n",
        good + "b.h5,0123456789abcdef,0123456789abcdef,more\n",
        good + "b.h5,0123456789abcdeg,0123456789abcdef\n"}) {
    write_file(file, wrong);
    EXPECT_THAT([&] { read_kept(folder_.path() / "kept"); },
                testing::ThrowsMessage<InputError>(testing::StartsWith(file.string() + ": expected ")))
        << wrong;
  }
}

TEST_F(KeptRuns, AreReadStrictly) {
  for (const char* name : {"page.json", "layer1/00.json", "statistics.json", "page/claims.json"}) {
    const fs::path file = out() / name;
    const std::string good = read_whole(file);
    const bool is_manifest =
        name != std::string("statistics.json") && name != std::string("page/claims.json");
    for (const auto& [what, text] : damages_of(good)) {
      write_file(file, text);
      const std::string told = complaint();
      EXPECT_THAT(told, Not(HasSubstr("\n"))) << what;
      if (is_manifest && what != " lacks seal") {
        EXPECT_THAT(told, testing::StartsWith(file.string() + ": ")) << what;
        EXPECT_THAT(told, HasSubstr("; `make all` of the profile makes ")) << what;
      } else if (!is_manifest) {
        EXPECT_THAT(told, HasSubstr(": damaged: expected sha256")) << what;
      }
    }
    write_file(file, good);
  }
}

TEST_F(KeptRuns, MustBeFinishedAndOfOnePiece) {
  std::ofstream(made("layer1/00.h5")) << "others";
  EXPECT_THAT(complaint(), HasSubstr("layer1/00.h5: damaged: expected sha256"));
  manifest("layer1/00.h5", {});
  EXPECT_THAT(complaint(), HasSubstr("was made from another layer1/00.h5 than is there now"));
  manifest("statistics.json", {"layer1/00.h5"});
  manifest("page", {"layer1/00.h5", "statistics.json"});
  EXPECT_EQ(complaint(), "no complaint");
  fs::remove(out() / "statistics.json.json");
  EXPECT_THAT(complaint(),
              HasSubstr("statistics.json.json: can't read: No such file or directory; `make all`"));
  fs::remove(out() / "page.json");
  EXPECT_THAT(complaint(), HasSubstr("holds no finished run"));
}

}  // namespace
}  // namespace hbr
