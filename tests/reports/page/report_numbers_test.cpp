#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "reports/text/format.h"
#include "tests/reports/page/report_fixture.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

// Rows of a table by their columns.
using Csv = std::vector<std::map<std::string, std::string>>;
std::vector<std::string> cells(const std::string& line) {
  std::vector<std::string> found(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ',' && !quoted)
      found.emplace_back();
    else if (c != '"')
      found.back() += c;
  }
  return found;
}
Csv read_csv(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  const std::vector<std::string> head = cells(line);
  Csv rows;
  while (std::getline(file, line)) {
    const std::vector<std::string> row = cells(line);
    EXPECT_EQ(row.size(), head.size()) << path << ": " << line;
    rows.emplace_back();
    for (std::size_t i = 0; i < std::min(row.size(), head.size()); ++i) rows.back()[head[i]] = row[i];
  }
  return rows;
}

// The summary says what the statistics hold: other numbers, other sentences; none, and it says so.
TEST_F(ReportTest, FindingsAreTheStatistics) {
  ReportContent content = full();
  const auto findings = [&] {
    fs::remove_all(folder_ / "report");
    write_report(content, folder_ / "report");
    const std::string page = read_bytes(folder_ / "report/index.html");
    const std::size_t begin = page.find("<ol class=\"findings\">");
    return page.substr(begin, page.find("</ol>", begin) - begin);
  };
  content.statistics["quantities"]["layer4.size"]["median"] = 98765;
  content.statistics["numbers"]["transfer.nao.absolute_median"]["value"] = 7.89;
  EXPECT_THAT(findings(), HasSubstr("98\u202f765"));
  EXPECT_THAT(findings(), HasSubstr("7.89"));
  content.statistics["quantities"] = nlohmann::json::object();
  content.statistics["numbers"] = nlohmann::json::object();
  const std::string nothing = std::regex_replace(findings(), std::regex("<[^>]*>"), "");
  EXPECT_THAT(nothing, Not(testing::ContainsRegex("[0-9]"))) << nothing;
}

// Tables are tidy: every row has all columns, and no file is without rows.
TEST_F(ReportTest, TablesAreTidy) {
  write_report(full(), folder_ / "report");
  int tables = 0;
  for (const auto& entry : fs::directory_iterator(folder_ / "report/figures")) {
    if (entry.path().extension() != ".csv") continue;
    ++tables;
    EXPECT_FALSE(read_csv(entry.path()).empty()) << entry.path();
  }
  EXPECT_GT(tables, 20);
  const Csv elites = read_csv(folder_ / "report/figures/digits_elites.csv");
  EXPECT_EQ(elites.size(), 600u);
  for (const char* column : {"panel", "elite", "latent_x", "latent_y", "fitness", "class", "good"})
    EXPECT_TRUE(elites[0].contains(column)) << column;
}

// What figures say of robots in numbers is what the statistics hold, and is not said where they do not.
TEST_F(ReportTest, SaysWhatWasMeasuredOfRobots) {
  const auto page = [&](const ReportContent& content) {
    fs::remove_all(folder_ / "report");
    write_report(content, folder_ / "report");
    return read_bytes(folder_ / "report/index.html");
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
  const Csv boxes = read_csv(folder_ / "report/figures/nao_tuned_boxes.csv");
  const auto shown = [&](const std::string& panel, const std::string& label) {
    for (const auto& row : boxes)
      if (row.at("panel") == panel && row.at("series") == label) return std::stod(row.at("median"));
    return -1e9;
  };
  const std::string mean = "Mean fitness of the digits", line = "Lines, from what was asked";
  EXPECT_DOUBLE_EQ(shown(mean, "arm"), median("tuned.arm.before.mean"));
  EXPECT_DOUBLE_EQ(shown(mean, "before"), median("tuned.nao.before.mean"));
  EXPECT_DOUBLE_EQ(shown(mean, "layer\u00a04"), median("tuned.nao.top.mean"));
  EXPECT_DOUBLE_EQ(shown(mean, "all"), median("tuned.nao.all.mean"));
  EXPECT_DOUBLE_EQ(shown(line, "arm"), 1000 * box("tuned.arm.before.line", "median"));
  EXPECT_DOUBLE_EQ(shown(line, "all"), 1000 * box("tuned.nao.all.line", "median"));

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

}  // namespace
}  // namespace hbr
