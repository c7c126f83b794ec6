#include "reports/page/report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <map>

#include "pipeline/core/check.h"
#include "reports/plot/figure.h"
#include "reports/text/format.h"
#include "tests/reports/page/synthetic_pictures.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

const nlohmann::json kVerdicts = nlohmann::json::parse(R"([
  {"id": "a", "statement": "1 < 2 & <i>so on</i>", "place": "5.1", "paper": "2.3", "verdict": "reproduced",
   "indication": "reproduced", "reason": "2 of 2 checks hold.", "checks": [
   {"words": "flat against <layer 3>", "kind": "ratio", "asked": "2 to 3 times", "ours": "2.4 times, n = 3", "figure": "2.4 times",
    "x": 2.4, "reproduced": [2, 3], "partly": [1, null], "outcome": "yes"},
   {"words": "share of good digits", "kind": "value", "asked": "at least 0.5", "ours": "0.6", "figure": "0.6",
    "x": 0.6, "reproduced": [0.5, 1], "partly": [0.25, 1], "outcome": "yes"}]},
  {"id": "b", "statement": "s", "place": "5.2", "paper": "p", "verdict": "not at this size", "indication": "partly",
   "reason": "r", "checks": [{"words": "w", "asked": "at least 1", "ours": "this run has no x", "outcome": "absent"}]}])");
const nlohmann::json kReadings = nlohmann::json::parse(R"([
  {"id": "disc", "title": "A disc", "paper": "nothing", "reading": "a disc", "alternatives": "a square", "effect": "e"}])");

const nlohmann::json kSpeed = nlohmann::json::parse(
    R"({"machine": "M", "compiler": "C", "flags": "-O3", "architecture": "A", "peers_from": "there",
  "rows": [{"what": "looking up", "item": "look-ups", "rate": 2e6, "against": "a scan", "reference_rate": 1e3, "with": {}, "peers": []}]})");

class ReportTest : public testing::Test {
 protected:
  ReportTest()
      : folder_(fs::temp_directory_path() / ("hbr-report-" + std::to_string(getpid()))), pictures_(folder_) {
    fs::create_directories(folder_);
  }
  ~ReportTest() override { fs::remove_all(folder_); }

  ReportContent full() {
    pictures_.everything(2);
    return {"reduced",
            Artifacts(pictures_.artifacts()),
            nlohmann::json::parse(read(fs::path(HBR_SOURCE_DIR) / "tests/reports/fixtures/statistics.json")),
            kVerdicts,
            kReadings,
            {},
            kSpeed};
  }
  std::map<std::string, std::string> files(const fs::path& report) {
    std::map<std::string, std::string> all;
    for (const auto& entry : fs::recursive_directory_iterator(report))
      if (entry.is_regular_file()) all[fs::relative(entry.path(), report).string()] = read(entry.path());
    return all;
  }

  fs::path folder_;
  SyntheticPictures pictures_;
};

TEST_F(ReportTest, GivesTheSameBytesTwice) {
  const ReportContent content = full();
  write_report(content, folder_ / "one");
  write_report(content, folder_ / "two");
  const auto one = files(folder_ / "one");
  EXPECT_TRUE(one == files(folder_ / "two"));
  for (const char* figure : {"points", "searches", "autoencoder", "digits", "continuum", "surest_digits",
                             "judge", "fooling", "substitution", "transfer", "coverage", "posture",
                             "dynamics", "tuned", "lines", "arcs", "arc_quality"})
    for (const char* kind : {".svg", ".pdf", ".csv"})
      EXPECT_TRUE(one.contains(std::string("figures/") + figure + kind)) << figure << kind;
  EXPECT_EQ(nlohmann::json::parse(one.at("claims.json")), kVerdicts);
  EXPECT_EQ(nlohmann::json::parse(one.at("speed.json")), kSpeed);
  EXPECT_THAT(one.at("index.html"), HasSubstr("<th scope=\"row\">looking up</th><td>2 M look-ups</td>"));
  EXPECT_EQ(nlohmann::json::parse(one.at("statistics.json")), content.statistics);
  for (const auto& [name, bytes] : one) EXPECT_THAT(bytes, Not(HasSubstr(folder_.string()))) << name;
}

TEST_F(ReportTest, NeedsNothingFromElsewhere) {
  write_report(full(), folder_ / "report");
  const std::string page = read(folder_ / "report/index.html");
  for (const char* foreign : {"src=\"http", "href=\"http", "url(http", "@import", "<link", "fetch("})
    EXPECT_EQ(page.find(foreign), std::string::npos) << foreign;
  EXPECT_EQ(page.find("{{"), std::string::npos);
  EXPECT_NE(page.find("1 &lt; 2 &amp; &lt;i&gt;so on&lt;/i&gt;"), std::string::npos);
  for (const char* robot : {"NAO", "NAO, along the stroke", "Six legs", "Six legs, along the stroke"})
    EXPECT_NE(page.find(std::string(">") + robot + "<"), std::string::npos) << robot;
  EXPECT_NE(page.find("NAO misses the lower left: 10 of 400 points"), std::string::npos);
  // Every id once.
  std::map<std::string, int> ids;
  for (const char quote : {'"', '\''}) {
    const std::string key = std::string(" id=") + quote;
    for (std::size_t at = page.find(key); at != std::string::npos; at = page.find(key, at + 1)) {
      const std::size_t begin = at + key.size();
      ++ids[page.substr(begin, page.find(quote, begin) - begin)];
    }
  }
  EXPECT_GT(ids.size(), 50u);
  for (const auto& [id, times] : ids) EXPECT_EQ(times, 1) << id;
}

// What figures say of robots in numbers is what the statistics hold, and is not said where they do not.
TEST_F(ReportTest, SaysWhatWasMeasuredOfRobots) {
  const auto page = [&](const ReportContent& content) {
    fs::remove_all(folder_ / "report");
    write_report(content, folder_ / "report");
    return read(folder_ / "report/index.html");
  };
  ReportContent content = full();
  const auto number = [&](const char* table, const char* name, const char* which) {
    return content.statistics[table][name][which].get<double>();
  };
  const auto box = [&](const char* name, const char* which) { return number("boxes", name, which); };
  const auto median = [&](const char* name) { return number("quantities", name, "median"); };
  const char* difference = "transfer.nao.absolute";
  const std::vector<std::string> sentences{
      fmt::format(
          "With the digit’s own box filling the image, the absolute difference is, in the median [least; "
          "greatest without outliers]: NAO {:.2f} % [{:.2f}; {:.2f}] ({:.1f} % of ",
          box(difference, "median"), box(difference, "low"), box(difference, "high"),
          100 * box(difference, "above") / box(difference, "n")),
      fmt::format("NAO reaches {}, holds {} within l as evolved and {} when moved.",
                  format_quantity(100 * number("numbers", "plane.nao.covered", "value"), "%"),
                  format_quantity(100 * median("projected.nao.within_before"), "%"),
                  format_quantity(100 * median("projected.nao.within_after"), "%")),
      fmt::format(
          "digits: arm {} mm (root mean square) from its way, at most {} of a torque limit, a limit reached "
          "at {} times the pace; body {} mm",
          format_number(box("dynamics.nao.arm_rms", "median")),
          format_quantity(box("dynamics.nao.arm_torque", "median"), "%"),
          format_number(box("dynamics.nao.arm_faster", "median")),
          format_number(box("dynamics.nao.whole_rms", "median"))),
      fmt::format("NAO: layer 4 alone gains {} where the arm’s gains {} (medians).",
                  format_number(median("tuned.nao.top.gain")), format_number(median("tuned.arm.top.gain"))),
  };
  const std::string whole = page(content);
  for (const std::string& sentence : sentences) EXPECT_THAT(whole, HasSubstr(sentence));
  EXPECT_THAT(whole, HasSubstr("does not say what its images show: 0.92 % [0.10; 2.11]"));

  // Boxes hold the statistics' numbers, each under the name of its state of the layers.
  const std::string table = read(folder_ / "report/figures/tuned.csv");
  const auto row = [&](const std::string& panel, const std::string& label, int x, double value) {
    Table one;
    one.add("NAO: " + panel, label, x, "median", value);
    const std::string text = one.csv();
    return text.substr(text.find("NAO"));
  };
  const std::string mean = "mean fitness of the digits", line = "lines, from what was asked";
  for (const std::string& expected : {row(mean, "arm", 1, median("tuned.arm.before.mean")),
                                      row(mean, "before", 2, median("tuned.nao.before.mean")),
                                      row(mean, "layer 4", 3, median("tuned.nao.top.mean")),
                                      row(mean, "all", 4, median("tuned.nao.all.mean")),
                                      row(line, "arm", 1, 1000 * box("tuned.arm.before.line", "median")),
                                      row(line, "all", 3, 1000 * box("tuned.nao.all.line", "median"))})
    EXPECT_THAT(table, HasSubstr(expected));

  // And a digit that does not move, whose distance from its way has no logarithm.
  content.statistics["boxes"]["dynamics.nao.whole_rms"]["low"] = 0;
  for (const char* name : {"transfer.nao.absolute", "dynamics.nao.arm_faster"})
    content.statistics["boxes"].erase(name);
  for (const char* name : {"projected.nao.within_after", "tuned.arm.top.gain"})
    content.statistics["quantities"].erase(name);
  const std::string less = page(content);
  for (const char* unsaid : {"outliers]: NAO", "digits: arm ", "NAO reaches", "where the arm’s gains"})
    EXPECT_THAT(less, Not(HasSubstr(unsaid)));
}

TEST_F(ReportTest, SaysWhatIsMissing) {
  const nlohmann::json nothing = {{"profile", "reduced"}, {"quantities", nlohmann::json::object()}};
  write_report({"reduced", Artifacts({}), nothing, nlohmann::json::array(), nlohmann::json::array()},
               folder_ / "report");
  const std::string page = read(folder_ / "report/index.html");
  for (const char* sentence :
       {"This run has no layer 1", "This run compared no searches.", "This run trained no autoencoder.",
        "This run has no digits: neither", "in a latent space to walk through", "no digits whose strokes",
        "This run has no digits of both", "No judge has looked", "This run did not exchange layer 1.",
        "no other robot", "no picture of a robot", "replayed no digit", "fine-tuned no digits",
        "This run has no lines", "This run has no arcs", "from fresh starts.", "This run drew no digits.",
        "No benchmarks are kept"})
    EXPECT_NE(page.find(sentence), std::string::npos) << sentence;
  EXPECT_TRUE(fs::is_empty(folder_ / "report/figures"));
}

TEST_F(ReportTest, RefusesWhatIsNotAsDescribed) {
  ReportContent content = full();
  content.claims[0]["verdict"] = "perhaps";
  EXPECT_THAT([&] { write_report(content, folder_ / "r"); },
              ThrowsMessage<InputError>(HasSubstr("claim 'a' has the verdict 'perhaps'")));
  content = full();
  content.readings[0].erase("effect");
  EXPECT_THAT([&] { write_report(content, folder_ / "r"); },
              ThrowsMessage<InputError>(HasSubstr("the reading 'disc' has no text 'effect'")));
  content = full();
  content.statistics["quantities"]["accuracy.n1"]["values"] = "three";
  EXPECT_THAT([&] { write_report(content, folder_ / "r"); },
              ThrowsMessage<InputError>(HasSubstr("the entry 'accuracy.n1' is not as")));
  content = full();
  std::ofstream(pictures_.artifacts().at("nao_picture") / "strip.png") << "no picture";
  EXPECT_THAT([&] { write_report(content, folder_ / "r"); },
              ThrowsMessage<InputError>(HasSubstr("strip.png is missing or no PNG")));
  EXPECT_THAT([&] { write_report(full(), "/proc/no/such"); },
              ThrowsMessage<InputError>(HasSubstr("cannot make /proc/no/such/figures")));
}

}  // namespace
}  // namespace hbr
