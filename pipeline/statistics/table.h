// What an experiment measured, with medians, tests and curves: the contents of statistics.json.
//
// {
//  "profile": name,
//  "quantities": one value per replication
//    {"layer2.n10.size": {"unit", "meaning", "values": [...], "replications": [...], "n", "median", "q1",
//    "q3",
//                         "min", "max"}},
//  "tests": rank-sum tests between two quantities
//    {"A_vs_B": {"a": A, "b": B, "n_a", "n_b", "p", "p_exact" (where computed), "least_p" (the floor of p at
//                these sizes), "a12", "ratio" (of medians, a over b; absent where that of b is 0),
//                "difference" (of medians, a less b)}},
//  "numbers": single figures {"layer2.n10.generations": {"unit", "meaning", "value"}},
//  "boxes": all values of all replications together, as a boxplot draws them
//    {"substitution.m1.original": {"unit", "meaning", "n", "median", "q1", "q3", "low", "high", "below",
//    "above",
//                                  "min", "max"}},
//  "curves": the course of searches and trainings, over the replications
//    {"layer4": {"x": "generation", "at": [...], "n", "size": {"median", "q1", "q3"}, "best": ..., "mean":
//    ...}}
// }
//
// Keys are sorted; there is no time, host or path: equal artifacts give equal bytes.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hbr {

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

}  // namespace hbr
