#include "reports/compare/compare_page.h"

#include <gmock/gmock.h>

#include <fstream>
#include <regex>

#include "pipeline/core/check.h"
#include "reports/compare/differences.h"
#include "tests/reports/kept/kept_runs.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

// A folder of artifacts and their manifests, made up.
class MadeUpRun {
 public:
  explicit MadeUpRun(fs::path out) : out_(std::move(out)) {}

  void artifact(const std::string& stage, const std::string& output, const std::string& bytes,
                const json& settings = json::object(), const std::string& program = "p",
                const std::string& input = "", const std::string& variation = "") {
    write(output, bytes);
    describe({"program", stage, 0, output, settings, {}, {}, variation}, program, input);
  }
  void statistics(const json& quantities, const json& numbers = json::object(),
                  const std::string& variation = "") {
    const std::string output = (variation.empty() ? "" : variation + "/") + "statistics.json";
    artifact("statistics.json", output,
             json{{"profile", "mine"},
                  {"quantities", quantities},
                  {"numbers", numbers},
                  {"tests", json::object()},
                  {"boxes", json::object()},
                  {"curves", json::object()}}
                 .dump(),
             json::object(), "p", "", variation);
  }
  void page(const json& claims) {
    write("page/claims.json", claims.dump());
    write("page/statistics.json", "{}");  // no artifact, it is part of one
    describe({"report", "page", -1, "page", json::object(), {}, {}}, "p", "");
  }
  ComparedRun read() const { return read_compared_run(out_); }
  const fs::path& out() const { return out_; }
  std::string version = "v1";

 private:
  void write(const std::string& output, const std::string& bytes) const {
    fs::create_directories((out_ / output).parent_path());
    std::ofstream(out_ / output) << bytes;
  }
  void describe(const Node& node, const std::string& program, const std::string& input) const {
    Manifest m;
    m.made_from.slice = slice_of(node);
    m.made_from.program = program;
    if (!input.empty()) m.made_from.inputs["below"] = input;
    m.key = m.made_from.key();
    m.content = content_of(out_ / node.output);
    m.fingerprint = fingerprint(out_ / node.output);
    m.run = kToolchain;
    m.run["version"] = version;
    m.run["host"] = "<here>";
    write_manifest(manifest_path(out_, node), m);
  }
  fs::path out_;
};

json claim(const std::string& id, const std::string& verdict, const std::string& indication,
           const std::string& ours = "1") {
  return {{"id", id},     {"place", "5.1"},     {"statement", "Statement " + id},
          {"ours", ours}, {"verdict", verdict}, {"indication", indication}};
}

class CompareRuns : public testing::Test {
 protected:
  CompareRuns() {
    a.artifact("layer1", "layer1/00.h5", "one", {{"seed", 1}, {"search", {{"batch", 5}}}});
    b.artifact("layer1", "layer1/00.h5", "two", {{"seed", 2}, {"search", {{"batch", 5}}}});
    a.artifact("layer2", "layer2/00.h5", "same", {{"seed", 1}});
    b.artifact("layer2", "layer2/00.h5", "same", {{"seed", 2}});
    a.artifact("layer2", "layer2/01.h5", "a", {{"seed", 1}, {"more", true}}, "p", "x");
    b.artifact("layer2", "layer2/01.h5", "b", {{"seed", 1}}, "q", "y");
    a.artifact("layer3", "layer3/00.h5", "only here");
    a.artifact("layer3", "short/layer3/00.h5", "a", {{"seed", 1}}, "p", "", "short");
    b.artifact("layer3", "short/layer3/00.h5", "b", {{"seed", 1}}, "p", "", "short");
  }
  std::string complaint(const fs::path& out) const {
    try {
      read_compared_run(out);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no complaint";
  }
  TemporaryFolder folder_;
  MadeUpRun a{folder_.path() / "one"}, b{folder_.path() / "other"};
};

TEST_F(CompareRuns, ByWhatTheirStagesWereTold) {
  const auto found = setting_differences(a.read(), b.read());
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].key, "more");
  EXPECT_EQ(found[0].a, "true");
  EXPECT_EQ(found[0].b, "");
  EXPECT_THAT(found[0].stages, ElementsAre("layer2"));
  EXPECT_EQ(found[1].key, "seed");
  EXPECT_EQ(found[1].a + found[1].b, "12");
  EXPECT_THAT(found[1].stages, ElementsAre("layer1", "layer2"));
  EXPECT_THAT(setting_differences(a.read(), a.read()), IsEmpty());
}

TEST_F(CompareRuns, ByTheBytesOfTheirArtifactsAndWhy) {
  const auto rows = stage_rows(a.read(), b.read());
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].stage, "layer1");
  EXPECT_THAT(rows[0].others, ElementsAre(std::pair("settings", 1u)));
  EXPECT_EQ(rows[1].stage, "layer2");
  EXPECT_EQ(rows[1].same, 1u);
  EXPECT_THAT(rows[1].others, ElementsAre(std::pair("settings, program, inputs", 1u)));
  EXPECT_FALSE(rows[1].only_in_one());
  EXPECT_EQ(rows[2].stage, "layer3");
  EXPECT_TRUE(rows[2].only_in_one());
  EXPECT_EQ(rows[2].only_a, 1u);
  EXPECT_EQ(rows[3].stage, "short/layer3");
  EXPECT_THAT(rows[3].others, ElementsAre(std::pair("", 1u)));  // from the same, and yet
  for (const StageRow& row : stage_rows(b.read(), b.read())) EXPECT_FALSE(row.differs()) << row.stage;
  const std::string page = compare_page(a.read(), b.read());
  EXPECT_THAT(page, HasSubstr("<b>only in A</b>"));
  // Without scripts the button that they answer to is not there.
  EXPECT_THAT(page, HasSubstr("<noscript><style>#theme { display: none; }</style></noscript>"));
  EXPECT_THAT(page, HasSubstr("<b>1 differ although made from the same</b>"));
  EXPECT_THAT(page, HasSubstr("1 the same; 1 differs: other settings, program, inputs"));
}

TEST_F(CompareRuns, ByVersionsAndCompilers) {
  b.version = "v2";
  b.artifact("judge", "judge.h5", "j");
  const auto rows = origins(a.read(), b.read());
  EXPECT_EQ(rows[0].word, "version");
  EXPECT_THAT(rows[0].a, ElementsAre("v1"));
  EXPECT_THAT(rows[0].b, ElementsAre("v1", "v2"));
  EXPECT_EQ(rows[1].a, rows[1].b);
}

TEST_F(CompareRuns, ByVerdictsTheMovedOnesFirst) {
  a.page({claim("same", "not", "not"), claim("moved", "partly", "partly", "3"),
          claim("points", "not at this size", "not"), claim("gone", "not", "not")});
  b.page({claim("same", "not", "not"), claim("moved", "reproduced", "reproduced", "4"),
          claim("points", "not at this size", "reproduced"), claim("new", "not", "not")});
  std::string moved;
  const auto rows = claim_rows(a.read(), b.read());
  for (const ClaimRow& row : rows)
    if (row.moved()) moved += row.either().at("id").get<std::string>() + " ";
  EXPECT_EQ(moved, "moved points ");
  EXPECT_EQ(rows.size(), 5u);
  const std::string page = compare_page(a.read(), b.read());
  EXPECT_LT(page.find("Statement moved"), page.find("Statement gone"));
  EXPECT_LT(page.find("Statement points"), page.find("Statement gone"));
  EXPECT_LT(page.find("Statement gone"), page.find("Statement same"));
  EXPECT_THAT(page, HasSubstr("<td>3</td><td><span class=\"badge partly\">"));
  EXPECT_THAT(page, HasSubstr("<b>2</b><span>claims moved"));
}

TEST_F(CompareRuns, ByTheirQuantitiesTheGreatestEffectFirst) {
  a.statistics({{"layer1.size", hbr::quantity("elites", {1, 2, 3, 4})},
                {"layer2.n10.size", hbr::quantity("elites", {1, 2, 3, 4})},
                {"layer3.n10.size", hbr::quantity("elites", {5, 5})},
                {"layer4.size", hbr::quantity("elites", {5, 5})}},
               {{"layer1.genes", hbr::number("genes", 8)}});
  b.statistics({{"layer1.size", hbr::quantity("elites", {2, 3, 4, 5})},
                {"layer2.n10.size", hbr::quantity("elites", {11, 12, 13, 14})},
                {"layer3.n10.size", hbr::quantity("elites", {5, 5})},
                {"layer2.n1.size", hbr::quantity("elites", {5, 5})}},
               {{"layer1.genes", hbr::number("genes", 6)}});
  const auto rows = measure_rows(a.read().statistics.at(""), b.read().statistics.at(""));
  std::vector<std::string> names;
  for (const MeasureRow& row : rows) names.push_back(row.name);
  EXPECT_THAT(names, ElementsAre("layer2.n10.size", "layer1.size", "layer1.genes", "layer2.n1.size",
                                 "layer3.n10.size", "layer4.size"));
  EXPECT_EQ(rows[0].test->a12, 1);          // every value of B is greater
  EXPECT_EQ(rows[1].test->a12, 11.5 / 16);  // 10 pairs, and three ties
  EXPECT_FALSE(rows[2].test);
  EXPECT_TRUE(rows[4].same());
  const std::string page = compare_page(a.read(), b.read());
  EXPECT_THAT(page, HasSubstr("<td>+10 (+400 %)</td>"));
  EXPECT_THAT(page, HasSubstr("1 quantity that both have alike"));
  EXPECT_THAT(page, HasSubstr("2 quantities of one run only"));
}

TEST_F(CompareRuns, OfVariationsEach) {
  for (MadeUpRun* run : {&a, &b}) run->statistics(json::object());
  a.statistics({{"layer1.size", hbr::quantity("elites", {1, 2})}}, json::object(), "short");
  b.statistics({{"layer1.size", hbr::quantity("elites", {3, 4})}}, json::object(), "short");
  b.statistics(json::object(), json::object(), "long");
  const std::string page = compare_page(a.read(), b.read());
  EXPECT_THAT(page, HasSubstr("<h3>Variation <code>short</code></h3>"));
  EXPECT_THAT(page, HasSubstr("Variations of one run only: <code>long (B)</code>"));
}

TEST_F(CompareRuns, UnfinishedOnesSayWhatIsMissing) {
  a.statistics(json::object());
  EXPECT_THAT(a.read().missing, ElementsAre(HasSubstr("no page")));
  EXPECT_THAT(b.read().missing, ElementsAre(HasSubstr("no statistics.json"), HasSubstr("no page")));
  const std::string page = compare_page(a.read(), b.read());
  EXPECT_THAT(page, HasSubstr("<h3>What is missing</h3>"));
  EXPECT_THAT(page, HasSubstr("<b>B</b>: There is no statistics.json"));
  EXPECT_THAT(page, HasSubstr("Neither run has verdicts yet."));
  EXPECT_THAT(page, HasSubstr("The two runs have no statistics in common."));
  // What is damaged is not compared.
  std::ofstream(a.out() / "statistics.json", std::ios::app) << " ";
  EXPECT_THAT(a.read().missing[0], HasSubstr("statistics.json is not compared"));
  EXPECT_THAT(a.read().statistics, IsEmpty());
  std::ofstream(a.out() / "layer1/00.json") << "{";
  EXPECT_THAT(a.read().missing[0], HasSubstr("Nothing is known of layer1/00.h5"));
  a.page({{{"id", "a"}}});
  EXPECT_THAT(a.read().missing.back(), HasSubstr("another version"));
}

TEST_F(CompareRuns, RefuseWhatIsNoRun) {
  EXPECT_THAT(complaint(folder_.path() / "nowhere"), HasSubstr("nowhere: there is no such folder"));
  fs::create_directories(folder_.path() / "empty");
  std::ofstream(folder_.path() / "empty/some.json") << "{}";
  EXPECT_THAT(complaint(folder_.path() / "empty"),
              HasSubstr("empty: no run: no artifact in it has a manifest"));
  EXPECT_THAT(complaint(a.out() / "layer1/00.h5"), HasSubstr("there is no such folder"));
}

// Read without a network, by a screen reader, and by whoever sees no colours.
TEST_F(CompareRuns, MakeAnAccessiblePage) {
  a.page({claim("moved", "partly", "partly")});
  b.page({claim("moved", "not", "not")});
  a.statistics({{"layer1.size", hbr::quantity("elites", {1, 2})}});
  b.statistics({{"layer1.size", hbr::quantity("elites", {3, 4})}});
  const std::string page = compare_page(a.read(), b.read());
  EXPECT_EQ(page, compare_page(a.read(), b.read()));
  const auto count = [&](const std::string& pattern) {
    const std::regex regex(pattern);
    return std::distance(std::sregex_iterator(page.begin(), page.end(), regex), {});
  };
  EXPECT_GT(count("<table"), 3);
  EXPECT_EQ(count("<table"), count("<caption>"));
  EXPECT_EQ(count("<table"), count("</table>"));
  EXPECT_EQ(count("<th scope="), count("<th[ >]"));
  EXPECT_EQ(count("<h1>"), 1);
  EXPECT_EQ(count("<section id="), count("<h2 id="));
  EXPECT_EQ(count("(src|href)=\"(?!#)"), 0);
  EXPECT_EQ(count("https?://"), 0);
  EXPECT_THAT(page, HasSubstr("lang=\"en\""));
  EXPECT_THAT(page, HasSubstr("prefers-color-scheme: dark"));
  EXPECT_THAT(page, HasSubstr("&lt;here&gt;"));
  EXPECT_THAT(page, Not(HasSubstr("<here>")));
}

}  // namespace
}  // namespace hbr
