#include "stages/plan/plan.h"

namespace hbr::inline stages {

using nlohmann::literals::operator""_json_pointer;

void plan_statistics(Plan& plan) {
  Inputs measured;
  std::vector<std::string> layers;
  for (const LayerRow& row : plan.rows()) layers.push_back(row.name);
  nlohmann::json generations = nlohmann::json::object();
  for (const Node& node : plan.graph()) {
    if (node.output.ends_with(".h5")) measured.emplace_back(node.output, node.output);
    if (const auto count = "/search/generations"_json_pointer; node.settings.contains(count))
      generations[node.stage] = node.settings[count];
  }
  plan.add({"statistics",
            "statistics",
            -1,
            "statistics.json",
            {{"profile", plan.profile().name},
             {"layers", layers},
             {"replications", settings_to_json(plan.profile().replications)},
             {"generations", generations}},
            measured,
            {}});
}

}  // namespace hbr::inline stages
