// A study of readings as a section of the page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hbr::inline reports {

// Of readings.json (study.h); null: this run studied none, and there is no section. `ledger` are the readings
// of reports/readings.toml, for their titles.
std::string study_html(const nlohmann::json& study, const nlohmann::json& ledger);

}  // namespace hbr::inline reports
