#include "pipeline/statistics/table.h"

#include <cmath>

#include "pipeline/core/check.h"
#include "pipeline/statistics/names.h"
#include "pipeline/statistics/rank_sum.h"
#include "pipeline/statistics/summary.h"

namespace hbr::inline statistics {
namespace {

nlohmann::json described(const std::string& name) {
  const auto meaning = meaning_of(name);
  HBR_CHECK(meaning.has_value(), "no meaning for '{}'", name);
  return {{"unit", meaning->unit}, {"meaning", meaning->text}};
}

void check_finite(const std::string& name, double value) {
  if (!std::isfinite(value)) throw InputError("{}: its value is {}; expected a finite number", name, value);
}

std::vector<double> values_of(const std::map<int, double>& by_replication) {
  std::vector<double> values;
  for (const auto& [replication, value] : by_replication) values.push_back(value);
  return values;
}

void put(nlohmann::json& object, const Summary& summary) {
  object["n"] = summary.n;
  object["median"] = summary.median;
  object["q1"] = summary.q1;
  object["q3"] = summary.q3;
  object["min"] = summary.minimum;
  object["max"] = summary.maximum;
}

}  // namespace

StatisticsTable::StatisticsTable(const std::string& profile) {
  rest_["profile"] = profile;
  for (const char* section : {"quantities", "numbers", "tests", "boxes", "curves"})
    rest_[section] = nlohmann::json::object();
}

void StatisticsTable::add(const std::string& name, int replication, double value) {
  check_finite(name, value);
  const bool fresh = quantities_[name].emplace(replication, value).second;
  if (!fresh) throw InputError("{}: replication {} is given twice", name, replication);
}

void StatisticsTable::number(const std::string& name, double value) {
  check_finite(name, value);
  nlohmann::json& numbers = rest_["numbers"];
  if (numbers.contains(name)) {
    const double before = numbers[name]["value"];
    if (before != value)
      throw InputError("{}: {} in one replication, {} in another; expected the same in all", name, before,
                       value);
    return;
  }
  numbers[name] = described(name);
  numbers[name]["value"] = value;
}

void StatisticsTable::box(const std::string& name, const std::vector<double>& values) {
  const Box b = hbr::box(values, name.c_str());
  nlohmann::json object = described(name);
  put(object, b.all);
  object["low"] = b.low;
  object["high"] = b.high;
  object["below"] = b.below;
  object["above"] = b.above;
  rest_["boxes"][name] = object;
}

void StatisticsTable::curve(const std::string& name, const std::string& x, const std::vector<double>& at,
                            const std::string& measure, const std::vector<std::vector<double>>& rows) {
  nlohmann::json& curve = rest_["curves"][name];
  curve["x"] = x;
  curve["at"] = at;
  curve["n"] = rows.size();
  std::vector<double> median, q1, q3;
  for (std::size_t i = 0; i < at.size(); ++i) {
    std::vector<double> column;
    for (const auto& row : rows) column.push_back(row[i]);
    const Summary s = summarise(column, name.c_str());
    median.push_back(s.median);
    q1.push_back(s.q1);
    q3.push_back(s.q3);
  }
  curve[measure] = {{"median", median}, {"q1", q1}, {"q3", q3}};
}

std::vector<std::string> StatisticsTable::names() const {
  std::vector<std::string> names;
  for (const auto& [name, values] : quantities_) names.push_back(name);
  return names;
}

void StatisticsTable::test(const std::string& a, const std::string& b) {
  if (!has(a) || !has(b)) return;
  const std::vector<double> values_a = values_of(quantities_.at(a)), values_b = values_of(quantities_.at(b));
  const RankSum result = rank_sum(values_a, values_b);
  const double median_a = summarise(values_a, a.c_str()).median;
  const double median_b = summarise(values_b, b.c_str()).median;
  nlohmann::json& test = rest_["tests"][a + "_vs_" + b];
  test = {{"a", a},
          {"b", b},
          {"n_a", values_a.size()},
          {"n_b", values_b.size()},
          {"p", result.p},
          {"least_p", least_p(values_a.size(), values_b.size())},
          {"a12", result.a12},
          {"difference", median_a - median_b}};
  if (result.p_exact) test["p_exact"] = *result.p_exact;
  if (median_b != 0) test["ratio"] = median_a / median_b;
}

nlohmann::json StatisticsTable::json() const {
  nlohmann::json result = rest_;
  for (const auto& [name, by_replication] : quantities_) {
    nlohmann::json object = described(name);
    const std::vector<double> values = values_of(by_replication);
    put(object, summarise(values, name.c_str()));
    object["values"] = values;
    for (const auto& [replication, value] : by_replication) object["replications"].push_back(replication);
    result["quantities"][name] = object;
  }
  return result;
}

}  // namespace hbr::inline statistics
