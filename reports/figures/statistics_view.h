// What the statistics hold, as figures need it. The format is that of pipeline/statistics/table.h.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/statistics/summary.h"
#include "reports/plot/plot.h"

namespace hbr::inline reports {

struct Test {
  std::optional<double> p = {};      // of kFewestToTest replications and more (rank_sum.h)
  double a12 = 0.5;                  // of a over b
  std::optional<double> ratio = {};  // of medians, a over b
  std::size_t n_a = 0, n_b = 0;
};

// Throws InputError, naming the entry, where statistics.json is not as its format says.
class StatisticsView {
 public:
  explicit StatisticsView(nlohmann::json statistics) : json_(std::move(statistics)) {}

  const nlohmann::json& json() const { return json_; }

  // One value per replication; empty where the quantity was not measured.
  std::vector<double> quantity(const std::string& name) const;
  // Names of the quantities that start and end so, sorted.
  std::vector<std::string> quantities(const std::string& prefix, const std::string& suffix = "") const;
  // A single number.
  std::optional<double> number(const std::string& name) const;
  // All values of all replications together.
  std::optional<Box> box(const std::string& name) const;
  // Between two quantities, whichever way round it is stored.
  std::optional<Test> test(const std::string& a, const std::string& b) const;
  // A curve's median and quartiles, without label and colour.
  std::optional<Band> curve(const std::string& name, const std::string& measure) const;

 private:
  const nlohmann::json* find(const char* table, const std::string& name) const;

  nlohmann::json json_;
};

}  // namespace hbr::inline reports
