// A report of every section, from small statistics and pictures of random numbers.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "reports/page/report.h"
#include "tests/reports/page/synthetic_pictures.h"

namespace hbr {

inline std::string read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

// All of `pattern`'s first groups, in the page's order.
inline std::vector<std::string> all_of(const std::string& page, const char* pattern) {
  std::vector<std::string> found;
  const std::regex expression(pattern);
  for (auto at = std::sregex_iterator(page.begin(), page.end(), expression); at != std::sregex_iterator();
       ++at)
    found.push_back((*at)[1]);
  return found;
}

inline const nlohmann::json kVerdicts = nlohmann::json::parse(R"([
  {"id": "a", "statement": "1 < 2 & <i>so on</i>", "place": "5.1", "paper": "2.3", "verdict": "reproduced",
   "indication": "reproduced", "reason": "2 of 2 checks hold.", "checks": [
   {"words": "flat against <layer 3>", "kind": "ratio", "asked": "2 to 3 times", "ours": "2.4 times, n = 3", "figure": "2.4 times",
    "x": 2.4, "reproduced": [2, 3], "partly": [1, null], "outcome": "yes"},
   {"words": "share of good digits", "kind": "value", "asked": "at least 0.5", "ours": "0.6", "figure": "0.6",
    "x": 0.6, "reproduced": [0.5, 1], "partly": [0.25, 1], "outcome": "yes"}]},
  {"id": "b", "statement": "s", "place": "5.2", "paper": "p", "verdict": "not at this size", "indication": "partly",
   "reason": "r", "checks": [{"words": "w", "asked": "at least 1", "ours": "this run has no x", "outcome": "absent"}]}])");
inline const nlohmann::json kReadings = nlohmann::json::parse(R"([
  {"id": "disc", "title": "A disc", "paper": "nothing", "reading": "a disc", "alternatives": "a square", "effect": "e"}])");

inline const nlohmann::json kSpeed = nlohmann::json::parse(
    R"({"machine": "M", "compiler": "C", "flags": "-O3", "architecture": "A", "peers_from": "there",
  "rows": [{"what": "looking up", "item": "look-ups", "rate": 2e6, "against": "a scan", "reference_rate": 1e3, "with": {}, "peers": []}]})");

inline const std::vector<LayerOfProfile> kLayers = {
    {"layer1", "points", "places of the pen, by joint angles", "", "places", ""},
    {"layer2_n10", "lines", "displacements of the pen", "layer1", "displacements", "places"},
    {"layer3_b", "arcs", "arcs, by five lines", "layer2_n10", "arcs", "displacements"},
    {"layer4", "digits", "digits, by one to three arcs", "layer3_b", "digits", "arcs"},
    {"flat_digits", "flat_digits", "digits, by configurations", "", "nothing", ""}};

class ReportTest : public testing::Test {
 protected:
  ReportTest()
      : folder_(std::filesystem::temp_directory_path() / ("hbr-report-" + std::to_string(getpid()))),
        pictures_(folder_) {
    std::filesystem::create_directories(folder_);
  }
  ~ReportTest() override { std::filesystem::remove_all(folder_); }

  ReportContent full() {
    pictures_.everything(2);
    return {"reduced",
            kLayers,
            {"nao", "six_legs"},
            Artifacts(pictures_.artifacts()),
            nlohmann::json::parse(
                read_bytes(std::filesystem::path(HBR_SOURCE_DIR) / "tests/reports/fixtures/statistics.json")),
            kVerdicts,
            kReadings,
            {},
            kSpeed};
  }
  std::map<std::string, std::string> files(const std::filesystem::path& report) {
    std::map<std::string, std::string> all;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(report))
      if (entry.is_regular_file())
        all[std::filesystem::relative(entry.path(), report).string()] = read_bytes(entry.path());
    return all;
  }

  std::filesystem::path folder_;
  SyntheticPictures pictures_;
};

}  // namespace hbr
