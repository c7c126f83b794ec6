// What an experiment measured, with medians, tests and curves: the contents of statistics.json, an object of
//
// profile     its name
// quantities  "layer2.n10.size": {unit, meaning, values, replications, n, median, q1, q3, min, max}
//             one value per replication
// tests       "A_vs_B": {a: "A", b: "B", n_a, n_b, p, p_exact, least_p, a12, ratio, difference}
//             rank-sum test between the quantities A and B (rank_sum.h); p_exact where it was computed;
//             least_p is the least p at these sizes; ratio and difference of the medians are a over b (absent
//             where that of b is 0) and a less b
// numbers     "layer2.n10.generations": {unit, meaning, value}
// boxes       "substitution.m1.original": {unit, meaning, n, median, q1, q3, low, high, below, above, min,
// max}
//             all values of all replications together; low and high end the whiskers, below and above count
//             the outliers
// curves      "layer4": {x: "generation", at, n, size: {median, q1, q3}, best: {...}, mean: {...}}
//             over the replications, of arcs also replaced; for "autoencoder" {x: "epoch", ..., train_error,
//             test_error}
//
// Shares are in [0, 1] and have the unit ""; what has the unit "%" is already in per cent. Keys are sorted;
// there is no time, host or path: equal artifacts give equal bytes.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hbr::inline statistics {

class StatisticsTable {
 public:
  explicit StatisticsTable(const std::string& profile);

  // The value of a quantity in one replication; each replication once. Every name must have a meaning
  // (names.h). Throws InputError where a value is not finite.
  void add(const std::string& name, int replication, double value);
  // A number given again must be the same (throws InputError).
  void number(const std::string& name, double value);
  void box(const std::string& name, const std::vector<double>& values);
  // rows[r][i]: the value of replication r at at[i].
  void curve(const std::string& name, const std::string& x, const std::vector<double>& at,
             const std::string& measure, const std::vector<std::vector<double>>& rows);

  // Names of the quantities, sorted.
  std::vector<std::string> names() const;
  bool has(const std::string& name) const { return quantities_.contains(name); }
  // The rank-sum test between two quantities; nothing happens where one is absent.
  void test(const std::string& a, const std::string& b);

  nlohmann::json json() const;

 private:
  std::map<std::string, std::map<int, double>> quantities_;
  nlohmann::json rest_;  // profile, numbers, tests, boxes, curves
};

}  // namespace hbr::inline statistics
