// The report: a folder that a browser opens without a network.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "reports/claims/sensitivity.h"
#include "reports/figures/artifacts.h"
#include "reports/page/layers.h"

namespace hbr::inline reports {

struct ReportContent {
  std::string profile;
  std::vector<LayerOfProfile> layers;
  std::vector<std::string> robots;  // beside the arm, by their names in the profile
  Artifacts artifacts;
  nlohmann::json statistics;  // statistics.json
  nlohmann::json claims;      // as evaluate_claims leaves them
  nlohmann::json readings;    // array of {id, title, paper, reading, alternatives, effect}
  std::vector<VariationClaims> variations = {};
  nlohmann::json speed = {};         // as condense_speed leaves it, or null where nobody measured
  std::filesystem::path three = {};  // folder of three.js; empty: robots are shown by pictures alone
  nlohmann::json study = {};         // readings.json, or null
};

// Makes `folder` with index.html (self-contained), statistics.json, claims.json, speed.json where there are
// benchmarks, sensitivity.json where there are variations, readings.json where
// readings were studied, and figures/ID.{svg,pdf}, ID_TABLE.csv.
// The same content gives the same bytes: no time, host or path is written.
void write_report(const ReportContent& content, const std::filesystem::path& folder);

}  // namespace hbr::inline reports
