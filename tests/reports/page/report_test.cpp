#include "reports/page/report.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>

#include "pipeline/artifact/unit_columns.h"
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

const std::vector<LayerOfProfile> kLayers = {
    {"layer1", "points", "places of the pen, by joint angles", "", "places", ""},
    {"layer2_n10", "lines", "displacements of the pen", "layer1", "displacements", "places"},
    {"layer3_b", "arcs", "arcs, by five lines", "layer2_n10", "arcs", "displacements"},
    {"layer4", "digits", "digits, by one to three arcs", "layer3_b", "digits", "arcs"},
    {"flat_digits", "flat_digits", "digits, by configurations", "", "nothing", ""}};

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
            kLayers,
            {"nao", "six_legs"},
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
  const std::string page = read(folder_ / "report/index.html");
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

// All of `pattern`'s first groups, in the page's order.
std::vector<std::string> all_of(const std::string& page, const char* pattern) {
  std::vector<std::string> found;
  const std::regex expression(pattern);
  for (auto at = std::sregex_iterator(page.begin(), page.end(), expression); at != std::sregex_iterator();
       ++at)
    found.push_back((*at)[1]);
  return found;
}

TEST_F(ReportTest, SectionsStandInTheOrderInWhichTheyAreRead) {
  write_report(full(), folder_ / "report");
  const std::string page = read(folder_ / "report/index.html");
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
  const std::string page = read(folder_ / "report/index.html");
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
  const std::string page = read(folder_ / "report/index.html");
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

// The summary says what the statistics hold: other numbers, other sentences; none, and it says so.
TEST_F(ReportTest, FindingsAreTheStatistics) {
  ReportContent content = full();
  const auto findings = [&] {
    fs::remove_all(folder_ / "report");
    write_report(content, folder_ / "report");
    const std::string page = read(folder_ / "report/index.html");
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

TEST_F(ReportTest, SaysWhatIsMissing) {
  const nlohmann::json nothing = {{"profile", "reduced"}, {"quantities", nlohmann::json::object()}};
  write_report(
      {"reduced", {}, {"nao"}, Artifacts({}), nothing, nlohmann::json::array(), nlohmann::json::array()},
      folder_ / "report");
  const std::string page = read(folder_ / "report/index.html");
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
              ThrowsMessage<InputError>(HasSubstr("strip.png is missing or no PNG")));
  EXPECT_THAT([&] { write_report(full(), "/proc/no/such"); },
              ThrowsMessage<InputError>(HasSubstr("cannot make /proc/no/such/figures")));
}

}  // namespace
}  // namespace hbr
