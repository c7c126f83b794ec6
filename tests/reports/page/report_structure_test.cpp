#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "pipeline/artifact/unit_columns.h"
#include "tests/reports/page/report_fixture.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::Not;
namespace fs = std::filesystem;

TEST_F(ReportTest, SectionsStandInTheOrderInWhichTheyAreRead) {
  write_report(full(), folder_ / "report");
  const std::string page = read_bytes(folder_ / "report/index.html");
  const std::vector<std::string> expected{"summary", "layers",   "explorer", "robots",    "claims",
                                          "figures", "readings", "speed",    "provenance"};
  EXPECT_EQ(all_of(page, "<section id=\"([^\"]*)\""), expected);
  for (const std::string& section : expected) EXPECT_THAT(page, HasSubstr("href=\"#" + section + "\""));
  EXPECT_THAT(page, HasSubstr("<a class=\"skip\" href=\"#main\">"));
  // The paper's figures in its order, the robots' in theirs.
  const std::vector<std::string> figures = all_of(page, "<figure id=\"figure-([^\"]*)\"");
  const auto at = [&](const char* id) { return std::ranges::find(figures, id) - figures.begin(); };
  EXPECT_LT(at("nao_posture"), at("nao_transfer"));
  EXPECT_LT(at("nao_tuned"), at("six_legs_posture"));
  EXPECT_LT(at("six_legs_posture"), at("autoencoder"));
  EXPECT_LT(at("autoencoder"), at("digits"));
  EXPECT_LT(at("digits"), at("substitution"));
  EXPECT_LT(at("substitution"), at("lines"));
  EXPECT_LT(at("lines"), at("arcs"));
  EXPECT_EQ(std::ssize(figures), at("layers") + 0);  // the profile has no layers of its own
}

// Whoever does not see the page learns what it shows; addresses lead somewhere.
TEST_F(ReportTest, FiguresAndTablesHaveNames) {
  write_report(full(), folder_ / "report");
  const std::string page = read_bytes(folder_ / "report/index.html");
  const auto count = [&](const char* pattern) { return all_of(page, pattern).size(); };
  const auto drawings = all_of(page, "(<svg [^>]*>)");
  EXPECT_GT(drawings.size(), 40u);
  std::set<std::string> described;
  for (const std::string& id : all_of(page, "<desc id=\"([^\"]*)\">[^<]{20,}")) described.insert(id);
  for (const std::string& drawing : drawings) {
    const bool labelled = drawing.find("aria-label=\"") != std::string::npos;  // a chart of one line
    const auto names = all_of(drawing, "aria-labelledby=\"[^ ]* ([^\"]*)\"");
    EXPECT_TRUE(labelled || (names.size() == 1 && described.contains(names[0]))) << drawing;
  }
  EXPECT_EQ(count("(<table)"), count("(<caption>[^<])"));
  EXPECT_EQ(count("(<th>)"), 0u);  // each says what it heads
  EXPECT_EQ(count("<figure id=\"(figure-[^\"]*)\""), count("<h4><a href=\"#(figure-[^\"]*)\""));
  std::set<std::string> ids;
  for (const std::string& id : all_of(page, " id=[\"']([^\"']*)[\"']")) ids.insert(id);
  for (const std::string& target : all_of(page, "href=\"#([^\"]*)\""))
    EXPECT_TRUE(ids.contains(target)) << target;
  for (const char* word : {"Left:", "Right:", "Middle", "Above:", "Below:"})
    EXPECT_THAT(page, Not(HasSubstr(word)));
}

TEST_F(ReportTest, ClaimsHaveARowForEachCheck) {
  write_report(full(), folder_ / "report");
  const std::string page = read_bytes(folder_ / "report/index.html");
  EXPECT_EQ(all_of(page, "<tbody id=\"claim-([^\"]*)\""), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(all_of(page, "<tr class=\"check\"><td>([^<]*)</td>"),
            (std::vector<std::string>{"flat against &lt;layer 3&gt;", "share of good digits", "w"}));
  EXPECT_EQ(all_of(page, "<svg class=\"range\"[^>]*aria-label=\"([^\"]*)\"").size(),
            2u);  // of those that were made
  EXPECT_THAT(
      page,
      HasSubstr("<td data-name=\"asked\">2 to 3 times</td><td data-name=\"this run\">2.4 times, n = 3</td>"));
  EXPECT_THAT(page, HasSubstr("○ not measured"));
}

TEST_F(ReportTest, TheDiagramIsTheProfiles) {
  const auto texts = [](const std::vector<LayerOfProfile>& layers) {
    return all_of(hierarchy_diagram(layers), "<text[^>]*>([^<]*)</text>");
  };
  const std::vector<std::string> all = texts(kLayers);
  for (const char* name : {"layer1", "layer2_n10", "layer3_b", "layer4", "flat_digits", "arcs"})
    EXPECT_THAT(all, testing::Contains(name));
  std::vector<LayerOfProfile> fewer(kLayers.begin(), kLayers.begin() + 2);
  fewer.push_back({"spirals", "spirals", "spirals, by lines", "layer2_n10", "spirals", "displacements"});
  EXPECT_THAT(texts(fewer), testing::Contains("spirals, by lines"));
  EXPECT_THAT(texts(fewer), Not(testing::Contains("layer4")));
  EXPECT_EQ(hierarchy_diagram({}), "");
}

// What a layer's descriptor and fitness are, its own artifact says.
TEST_F(ReportTest, TheLayersTableIsTheArtifacts) {
  const fs::path path = folder_ / "layer9.h5";
  Hdf5Writer file(path);
  for (const char* array : {"measures", "objective"}) file.write(array, std::vector<float>{0});
  write_unit_columns(file, "measures", {{"a", "<b>"}, {"m", "rad^2"}, 0, 1, {0, 0}, {1, 1}});
  write_value_meaning(file, "objective", {"minus the cost (m^2)", ""});
  file.close();
  const Evidence evidence{Artifacts({{"layer9/00.h5", path}}), StatisticsView(full().statistics)};
  const std::string table =
      layers_table({{"layer9", "points", "places", "", "places", ""}, kLayers[3]}, evidence);
  EXPECT_THAT(table, HasSubstr("<td>a (m), &lt;b&gt; (rad²)</td><td>minus the cost (m²)</td>"));
  EXPECT_THAT(table, HasSubstr("<td>arcs of <code>layer3_b</code></td><td>–</td><td>–</td>"));
}

}  // namespace
}  // namespace hbr
