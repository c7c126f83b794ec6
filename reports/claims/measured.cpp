#include "reports/claims/measured.h"

#include "pipeline/core/check.h"
#include "pipeline/statistics/rank_sum.h"

namespace hbr::inline reports {

using nlohmann::json;

StatisticsReader::StatisticsReader(const json& contents) : json_(contents) {
  for (const char* section : {"quantities", "numbers"})
    if (!json_.is_object() || !json_.contains(section) || !json_[section].is_object())
      throw InputError("statistics: no table '{}'; expected the contents of statistics.json", section);
}

std::optional<Statistic> StatisticsReader::figure(const std::string& name) const {
  if (const json& all = json_["quantities"]; all.contains(name)) {
    const json& q = all[name];
    return Statistic{q.at("unit"), q.at("median"), q.at("q1"), q.at("q3"), q.at("values")};
  }
  if (const json& all = json_["numbers"]; all.contains(name)) {
    const double value = all[name].at("value");
    return Statistic{all[name].at("unit"), value, value, value, {}};
  }
  return {};
}

std::optional<double> computed(const std::string& kind, const Statistic& of, const Statistic& to) {
  if (kind == "value") return of.median;
  if (kind == "difference") return of.median - to.median;
  if (kind == "ratio" && to.median != 0) return of.median / to.median;
  if (kind == "a12" && !of.values.empty() && !to.values.empty()) return rank_sum(of.values, to.values).a12;
  return {};
}

}  // namespace hbr::inline reports
