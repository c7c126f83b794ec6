#include "reports/kept/kept_run.h"

#include <gmock/gmock.h>

#include <fstream>

#include "pipeline/artifact/freshness.h"
#include "pipeline/core/check.h"
#include "reports/kept/verify.h"
#include "tests/reports/kept/kept_runs.h"
#include "tests/support/damaged_json.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

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
        << R"([{"id": "a", "paper": "", "ours": "", "verdict": "not", "indication": "not", "decided_by": "result", "reason": "r"}])";
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
    node.stage = output.substr(0, output.find('/'));
    node.settings = {{"x", 1}};
    Manifest m;
    for (const std::string& input : inputs) {
      node.inputs.emplace_back(input, input);
      m.made_from.inputs[input] = content_of(out() / input).sha256;
    }
    m.made_from.slice = slice_of(node);
    m.key = m.made_from.key();
    m.content = content_of(out() / output);
    m.fingerprint = fingerprint(out() / output);
    m.run = kToolchain;
    m.run["version"] = "v1";
    m.run["seconds"] = 3;
    m.run["cpu_seconds"] = 5;
    m.run["peak_memory_bytes"] = 7'000'000;
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

// A rule that changes changes the kept verdicts: `make figures` writes them.
TEST(KeptReferences, HaveTheVerdictsOfTheRules) {
  const std::string reports = std::string(HBR_SOURCE_DIR) + "/reports";
  const auto all = read_all_kept(reports + "/reference");
  EXPECT_TRUE(all.contains("paper"));
  for (const auto& [name, run] : all)
    EXPECT_EQ(run.claims, claims_anew(run, reports + "/claims.toml")) << name << ": make figures";
}

TEST_F(KeptRuns, ComeBackAsTheyWere) {
  const KeptRun run = read_run(out());
  EXPECT_EQ(run.profile, "p");
  EXPECT_EQ(run.toolchain, kToolchain);
  EXPECT_EQ(run.artifacts.size(), 1u);
  EXPECT_EQ(run.artifacts.at("layer1/00.h5").bytes, sha256_of_text("bytes").substr(0, 16));
  EXPECT_FALSE(run.statistics.at("").contains("curves"));
  EXPECT_EQ(run.costs.at("layer1"), (StageCost{1, 3, 5, 7e6, 5}));
  EXPECT_EQ(whole_cost(run.costs).cpu_seconds, 15);
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
    EXPECT_EQ(again.costs, each.costs);
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

TEST_F(KeptRuns, TheListOfCostsIsReadStrictly) {
  write_kept(kept(), folder_.path() / "kept");
  const fs::path file = folder_.path() / "kept/costs.csv";
  const std::string good = read_whole(file);
  for (const std::string& wrong :
       {std::string(), "x" + good, good + "\n", good + "a,1,1,1,1\n", good + "a,1,1,1,1,1,1\n",
        good + "a,1,1,1,1,-1\n", good + "a,1,nan,1,1,1\n", good + "a,1,1;1,1,1\n",
        good + "a,1,1,1,1,1\na,1,1,1,1,1\n"}) {
    write_file(file, wrong);
    EXPECT_THAT([&] { read_kept(folder_.path() / "kept"); },
                testing::ThrowsMessage<InputError>(testing::StartsWith(file.string() + ": expected ")))
        << wrong;
  }
  fs::remove(file);
  EXPECT_TRUE(read_kept(folder_.path() / "kept").costs.empty());
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
