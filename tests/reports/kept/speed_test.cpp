#include "reports/kept/speed.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "pipeline/artifact/content.h"
#include "pipeline/core/check.h"
#include "tests/support/damaged_json.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

constexpr const char* kRows = R"(
peers_from = "elsewhere"
[[rows]]
what = "a < b"
item = "looks"
benchmark = "fast/10"
against = "one by one"
reference = "slow"
with = ["mean_fitness"]
peers = [{name = "other", rate = 250}]
[[rows]]
what = "alone"
item = "looks"
benchmark = "other"
against = ""
reference = ""
with = []
peers = []
)";

json repetition(const std::string& name, double rate) {
  return {{"name", name},
          {"run_name", name},
          {"run_type", "iteration"},
          {"items_per_second", rate},
          {"mean_fitness", -0.5}};
}

class Speed : public testing::Test {
 protected:
  Speed() { std::ofstream(folder_.path() / "rows.toml") << kRows; }
  std::filesystem::path results(const std::string& name, const json& benchmarks) {
    std::ofstream(folder_.path() / name) << json{{"benchmarks", benchmarks}};
    return folder_.path() / name;
  }
  json condensed(const std::vector<std::filesystem::path>& files, bool whole) {
    return condense_speed(folder_.path() / "rows.toml", files, whole);
  }
  TemporaryFolder folder_;
};

TEST_F(Speed, TheFastestOfTheRepetitionsCounts) {
  json mean = repetition("fast/10/iterations:1", 9e9);
  mean["run_type"] = "aggregate";
  const auto one = results("one.json", {repetition("fast/10/iterations:1", 1000),
                                        repetition("fast/10/iterations:1", 2500), mean,
                                        repetition("fast/10/iterations:1", 2000)}),
             two = results("two.json", {repetition("slow", 125), repetition("nobody asks", 7)});
  const json speed = condensed({one, two}, false);
  ASSERT_EQ(speed["rows"].size(), 1u);
  EXPECT_EQ(speed["rows"][0]["rate"], 2500);
  EXPECT_EQ(speed["rows"][0]["reference_rate"], 125);
  EXPECT_EQ(speed["rows"][0]["with"], (json{{"mean_fitness", -0.5}}));
  EXPECT_THAT(speed["compiler"].get<std::string>(), testing::AnyOf(HasSubstr("GCC"), HasSubstr("Clang")));
  const std::string text = speed_markdown(speed);
  EXPECT_THAT(text,
              HasSubstr("| a < b; mean fitness −0.500 | 2.5 k looks | 400 µs | 125 (one by one) | 20x |"));
  EXPECT_THAT(text, HasSubstr("| other | 250 looks | 2.5 k | 10x |"));
  EXPECT_THAT(text, HasSubstr("elsewhere"));
  const std::string page = speed_html(speed);
  EXPECT_THAT(page, HasSubstr("<th scope=\"row\">a &lt; b; mean fitness −0.500</th><td>2.5 k looks</td>"));
  EXPECT_THAT(page, HasSubstr("<td>10x</td>"));
}

TEST_F(Speed, WithoutItsReferenceARowStandsAlone) {
  const json speed = condensed({results("one.json", json::array({repetition("fast/10", 2e9)}))}, false);
  EXPECT_TRUE(speed["rows"][0]["reference_rate"].is_null());
  EXPECT_THAT(speed_markdown(speed), HasSubstr("| 2 G looks | 0.5 ns |  |  |"));
}

std::string failure(const std::function<void()>& run) {
  try {
    run();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(Speed, SaysWhatIsMissing) {
  const auto fast = results("fast.json", json::array({repetition("fast/10", 1)}));
  EXPECT_THAT(failure([&] { condensed({fast}, true); }), HasSubstr("the benchmark 'slow' is not among"));
  json without = repetition("fast/10", 1);
  without.erase("mean_fitness");
  EXPECT_THAT(failure([&] { condensed({results("x.json", json::array({without}))}, false); }),
              HasSubstr("'fast/10' has no counter 'mean_fitness'"));
  EXPECT_THAT(failure([&] { condensed({folder_.path() / "none.json"}, false); }),
              HasSubstr("none.json: can't read: No such file"));
  EXPECT_THAT(failure([] { speed_html({{"rows", 3}}); }), HasSubstr("not as described"));
  EXPECT_THAT(speed_html(json()), HasSubstr("No benchmarks are kept"));
}

TEST_F(Speed, ResultsAndTheKeptTableAreReadStrictly) {
  const auto file = results("one.json", {repetition("fast/10", 1000), repetition("slow", 125)});
  const json speed = condensed({file}, false);
  const auto damaged_results = damages_of(read_whole(file));
  std::size_t refusals = 0;
  for (const auto& [what, text] : damaged_results) {
    write_file(file, text);
    const std::string told = failure([&] { condensed({file}, false); });
    EXPECT_THAT(told, Not(HasSubstr("\n"))) << what;
    EXPECT_THAT(told, Not(HasSubstr("json.exception"))) << what;
    refusals += told.starts_with(file.string() + ": ");
  }
  EXPECT_GT(refusals, damaged_results.size() / 3);  // much of it nobody asks for
  for (const auto& [pointer, value, told] :
       {std::tuple("/benchmarks/0/run_name", json(3), "benchmarks.0: run_name: expected a text"),
        {"/benchmarks/0/items_per_second", json("x"), "benchmarks.0: items_per_second: expected a number"},
        {"/benchmarks/0", json(3), "benchmarks.0: expected a table"},
        {"/benchmarks", json{{"a", 1}}, "expected a table with the list 'benchmarks'"}}) {
    json changed{{"benchmarks", {repetition("fast/10", 1000), repetition("slow", 125)}}};
    changed[json::json_pointer(pointer)] = value;
    write_file(file, changed.dump());
    EXPECT_THAT(failure([&] { condensed({file}, false); }), HasSubstr(file.string() + ": "));
    EXPECT_THAT(failure([&] { condensed({file}, false); }), HasSubstr(told));
  }
  const auto all = damages_of(speed.dump(1));
  refusals = 0;
  for (const auto& [what, text] : all) {
    write_file(file, text);
    const std::string told = failure([&] { speed_html(read_speed(file)); });
    EXPECT_THAT(told, Not(HasSubstr("\n"))) << what;
    refusals += told.starts_with(file.string() + ": ");
  }
  EXPECT_GT(refusals, all.size() / 2);
}

// What is kept with the sources is whole, and what the list of benchmarks asks for.
TEST(KeptSpeed, HoldsTheTable) {
  const json kept = read_speed(std::string(HBR_SOURCE_DIR) + "/reports/reference/bench.json");
  EXPECT_THAT(speed_markdown(kept), HasSubstr("layer 1, whole run of 10 000 x 200; elites"));
  std::ifstream rows(std::string(HBR_SOURCE_DIR) + "/tests/benchmarks.toml");
  std::size_t listed = 0;
  for (std::string line; std::getline(rows, line);) listed += line == "[[rows]]";
  EXPECT_EQ(kept["rows"].size(), listed);
}

}  // namespace
}  // namespace hbr
