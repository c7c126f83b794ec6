#include "reports/page/report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/core/check.h"
#include "tests/reports/page/report_fixture.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;
namespace fs = std::filesystem;

TEST_F(ReportTest, GivesTheSameBytesTwice) {
  const ReportContent content = full();
  write_report(content, folder_ / "one");
  write_report(content, folder_ / "two");
  const auto one = files(folder_ / "one");
  EXPECT_TRUE(one == files(folder_ / "two"));
  for (const char* figure : {"points", "searches", "autoencoder", "digits", "continuum", "surest_digits",
                             "judge", "fooling", "substitution", "nao_transfer", "nao_coverage",
                             "nao_posture", "nao_dynamics", "nao_tuned", "lines", "arcs", "arc_quality"})
    for (const char* kind : {".svg", ".pdf"})
      EXPECT_TRUE(one.contains(std::string("figures/") + figure + kind)) << figure << kind;
  EXPECT_EQ(nlohmann::json::parse(one.at("claims.json")), kVerdicts);
  EXPECT_EQ(nlohmann::json::parse(one.at("speed.json")), kSpeed);
  EXPECT_THAT(one.at("index.html"), HasSubstr("<th scope=\"row\">looking up</th><td>2 M look-ups</td>"));
  EXPECT_EQ(nlohmann::json::parse(one.at("statistics.json")), content.statistics);
  for (const auto& [name, bytes] : one) EXPECT_THAT(bytes, Not(HasSubstr(folder_.string()))) << name;
}

TEST_F(ReportTest, NeedsNothingFromElsewhere) {
  write_report(full(), folder_ / "report");
  const std::string page = read_bytes(folder_ / "report/index.html");
  for (const char* foreign : {"src=\"http", "href=\"http", "url(http", "@import", "<link", "fetch("})
    EXPECT_EQ(page.find(foreign), std::string::npos) << foreign;
  EXPECT_EQ(page.find("{{"), std::string::npos);
  EXPECT_NE(page.find("1 &lt; 2 &amp; &lt;i&gt;so on&lt;/i&gt;"), std::string::npos);
  for (const char* robot : {"NAO", "Six legs"})
    EXPECT_NE(page.find(std::string("<h3>") + robot + "<"), std::string::npos) << robot;
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

TEST_F(ReportTest, SaysWhatIsMissing) {
  const nlohmann::json nothing = {{"profile", "reduced"}, {"quantities", nlohmann::json::object()}};
  write_report(
      {"reduced", {}, {"nao"}, Artifacts({}), nothing, nlohmann::json::array(), nlohmann::json::array()},
      folder_ / "report");
  const std::string page = read_bytes(folder_ / "report/index.html");
  for (const char* sentence :
       {"This run has no layer 1", "This run compared no searches.", "This run trained no autoencoder.",
        "This run has no digits: neither", "in a latent space to walk through", "no digits whose strokes",
        "This run has no digits of both", "No judge has looked", "This run did not exchange layer 1.",
        "does not draw the arm’s digits", "no picture of the robot", "No digit was replayed",
        "did not evolve on over", "This run has no lines", "This run has no arcs", "from fresh starts.",
        "This run drew no digits.", "No benchmarks are kept"})
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
              ThrowsMessage<InputError>(HasSubstr(
                  "strip.png is missing or no PNG; delete its folder and give the same make again")));
  EXPECT_THAT([&] { write_report(full(), "/proc/no/such"); },
              ThrowsMessage<InputError>(HasSubstr("/proc/no/such/figures: can't make this folder")));
}

}  // namespace
}  // namespace hbr
