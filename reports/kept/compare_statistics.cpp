#include "reports/kept/compare_statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "pipeline/statistics/rank_sum.h"
#include "pipeline/statistics/summary.h"
#include "pipeline/statistics/t_test.h"

namespace hbr::inline reports {
namespace {

using nlohmann::json;

constexpr double kLevel = 0.01, kOfNumber = 0.1, kOfShare = 0.02;

// Functions of the settings alone: "layer1.generations", and not "layer1.covering_generations".
bool is_count(const std::string& name, const std::string& unit) {
  constexpr std::array kCounts = {"evaluations", "executions", "generations", "requests", "epochs"};
  return unit == "genes" || (std::ranges::find(kCounts, unit) != kCounts.end() && name.ends_with("." + unit));
}

std::string kind_of(const std::string& name) { return name.substr(0, name.find('.')); }

struct Quantity {
  std::string unit;
  std::map<int, double> values;  // by replication

  std::vector<double> list() const {
    std::vector<double> all;
    for (const auto& [replication, value] : values) all.push_back(value);
    return all;
  }
  double median() const { return summarise(list(), "").median; }
};

Quantity quantity(const json& entry) {
  Quantity q{entry.at("unit"), {}};
  const std::vector<int> replications = entry.at("replications");
  const std::vector<double> values = entry.at("values");
  for (std::size_t i = 0; i < values.size(); ++i) q.values[replications.at(i)] = values[i];
  return q;
}

// One pair of statistics: the run's, or a variation's.
class Comparison {
 public:
  Comparison(const json& reference, const json& run, const std::string& variation, bool exact,
             Verification& result)
      : reference_(reference),
        run_(run),
        lead_(variation.empty() ? "" : variation + ": "),
        exact_(exact),
        result_(result) {}

  void compare() {
    const json &was = reference_.at("quantities"), &is = run_.at("quantities");
    for (const auto& [name, entry] : was.items())
      if (is.contains(name) && !is_count(name, entry.at("unit"))) ++tested_;
    for (const auto& [name, entry] : was.items())
      if (is.contains(name)) quantities(name, quantity(entry), quantity(is.at(name)));
    const json &numbers_were = reference_.at("numbers"), &numbers_are = run_.at("numbers");
    for (const auto& [name, entry] : numbers_were.items())
      if (numbers_are.contains(name) && (exact_ || numbers_are.at(name).at("unit") != "class"))
        number(name, entry.at("unit"), entry.at("value"), numbers_are.at(name).at("value"));
    if (too_few_ > 0)
      note(fmt::format("{} quantities and numbers are of fewer than {} replications, which tell nothing",
                       too_few_, kFewestToTest));
    only_in_one(was, is, "quantities");
    only_in_one(numbers_were, numbers_are, "numbers");
    for (const auto& [sizes, count] : sizes_)
      note(fmt::format("{} of the quantities have {} replications here and {} in the reference{}", count,
                       sizes.second, sizes.first, exact_ ? "; those that both have are compared" : ""));
  }
  std::size_t compared() const { return compared_; }

 private:
  void differ(const std::string& line) { result_.differences.push_back(lead_ + line); }
  void note(const std::string& line) { result_.notes.push_back(lead_ + line); }

  void pass_over() {
    ++too_few_;
    --compared_;
  }

  void quantities(const std::string& name, const Quantity& was, const Quantity& is) {
    ++compared_;
    if (was.values.size() != is.values.size()) ++sizes_[{was.values.size(), is.values.size()}];
    if (exact_ || is_count(name, was.unit))
      same_values(name, was, is);
    else
      same_distribution(name, was, is);
  }

  void same_values(const std::string& name, const Quantity& was, const Quantity& is) {
    std::vector<int> others;
    int both = 0;
    for (const auto& [replication, value] : was.values)
      if (const auto found = is.values.find(replication); found != is.values.end()) {
        ++both;
        if (found->second != value) others.push_back(replication);
      }
    if (others.empty()) return;
    const int first = others[0];
    differ(fmt::format(
        "{}: {} of {} replications differ; replication {} was {}, is {}; median {}, is {}; p = {:.2g}", name,
        others.size(), both, first, was.values.at(first), is.values.at(first), was.median(), is.median(),
        rank_sum(was.list(), is.list()).p));
  }

  void same_distribution(const std::string& name, const Quantity& was, const Quantity& is) {
    if (std::min(was.values.size(), is.values.size()) < kFewestToTest) return pass_over();
    const double level = kLevel / static_cast<double>(tested_);
    const bool by_ranks = least_p(was.values.size(), is.values.size()) < level;
    const double p = by_ranks ? rank_sum(was.list(), is.list()).p : t_test(was.list(), is.list());
    if (p < level)
      differ(fmt::format("{}: median was {}, is {} (n = {} and {}); p = {:.2g}, expected at least {:.2g}",
                         name, was.median(), is.median(), was.values.size(), is.values.size(), p, level));
  }

  // The interval of a number, where both have one.
  struct Ends {
    double low, high;
  };
  static std::optional<Ends> ends(const json& numbers, const std::string& name) {
    const auto low = numbers.find(name + "_low"), high = numbers.find(name + "_high");
    if (low == numbers.end() || high == numbers.end()) return {};
    return Ends{low->at("value"), high->at("value")};
  }

  // Whether what a number tells of was measured in too few replications.
  bool few_of(const std::string& kind) const {
    for (const auto& [name, entry] : run_.at("quantities").items())
      if (kind_of(name) == kind && entry.at("values").size() < kFewestToTest) return true;
    return false;
  }

  // Of a number's interval: the whiskers of a box are ends, too, but of no number.
  static bool is_an_end(const json& numbers, const std::string& name) {
    for (const std::string end : {"_low", "_high"})
      if (const std::string whose = name.substr(0, name.size() - std::min(name.size(), end.size()));
          name.ends_with(end) && numbers.contains(whose) && ends(numbers, whose))
        return true;
    return false;
  }

  void number(const std::string& name, const std::string& unit, double was, double is) {
    ++compared_;
    if (was == is) return;
    if (!exact_ && !is_count(name, unit)) {
      if (few_of(kind_of(name))) return pass_over();
      if (is_an_end(reference_.at("numbers"), name)) return;
      const auto before = ends(reference_.at("numbers"), name), now = ends(run_.at("numbers"), name);
      if (before && now) {
        if (before->high < now->low || now->high < before->low)
          differ(fmt::format("{}: was {} [{}; {}], is {} [{}; {}]; expected intervals that overlap", name,
                             was, before->low, before->high, is, now->low, now->high));
        return;
      }
    }
    if (exact_ || is_count(name, unit)) return differ(fmt::format("{}: was {}, is {}", name, was, is));
    const double allowed = unit.empty() ? kOfShare : unit == "%" ? 100 * kOfShare : kOfNumber * std::abs(was);
    if (std::abs(is - was) > allowed)
      differ(
          fmt::format("{}: was {}, is {}; expected {} to {}", name, was, is, was - allowed, was + allowed));
  }

  // Names that `of` has and `other` lacks, by their kind.
  static std::map<std::string, std::vector<std::string>> lacking(const json& of, const json& other) {
    std::map<std::string, std::vector<std::string>> kinds;
    for (const auto& [name, entry] : of.items())
      if (!other.contains(name)) kinds[kind_of(name)].push_back(name);
    return kinds;
  }

  void only_in_one(const json& was, const json& is, const char* what) {
    std::set<std::string> kinds;
    for (const auto& [name, entry] : is.items()) kinds.insert(kind_of(name));
    for (const auto& [kind, names] : lacking(was, is)) {
      if (!kinds.contains(kind))
        note(fmt::format("{}: this run has nothing of it; {} {} of the reference are not compared", kind,
                         names.size(), what));
      else
        for (const std::string& name : names)
          differ(fmt::format("{}: in the reference, but not in this run", name));
    }
    for (const auto& [kind, names] : lacking(is, was))
      note(fmt::format("{}: {} {} of this run are not in the reference and not compared ({}{})", kind,
                       names.size(), what, names[0], names.size() > 1 ? ", ..." : ""));
  }

  const json &reference_, &run_;
  std::string lead_;
  bool exact_;
  Verification& result_;
  std::size_t tested_ = 0, compared_ = 0, too_few_ = 0;
  std::map<std::pair<std::size_t, std::size_t>, int> sizes_;  // of reference and run -> quantities
};

}  // namespace

std::size_t compare_statistics(const json& reference, const json& run, const std::string& variation,
                               bool exact, Verification& result) {
  Comparison comparison(reference, run, variation, exact, result);
  comparison.compare();
  return comparison.compared();
}

}  // namespace hbr::inline reports
