// Are arcs, not abrupt angles, the reason why the judge accepts more digits of one repertoire than of
// another?
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <span>
#include <utility>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/inference.h"
#include "pipeline/statistics/rank_sum.h"
#include "pipeline/statistics/readers.h"
#include "pipeline/statistics/summary.h"

namespace hbr::inline statistics {
namespace {

// Digits with a turn, of one replication.
struct Turned {
  std::vector<double> turn;  // degrees, mean of a digit's turns without their sense
  std::vector<std::uint8_t> good;

  std::vector<double> where(bool is_good) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < turn.size(); ++i)
      if ((good[i] != 0) == is_good) values.push_back(turn[i]);
    return values;
  }
};

Turned read_group(const Hdf5Reader& file, const std::string& group, int replication, StatisticsTable& table) {
  const auto turns = file.read<std::int32_t>(group + "/turns").values;
  const auto turn = file.read<float>(group + "/turn").values,
             length = file.read<float>(group + "/length").values,
             side = file.read<float>(group + "/side").values;
  const auto joint = file.read<std::uint8_t>(group + "/joint").values,
             good = file.read<std::uint8_t>(group + "/good").values;
  std::size_t all = 0;
  for (const std::int32_t n : turns) all += n < 0 ? turn.size() + 1 : static_cast<std::size_t>(n);
  if (turns.empty() || good.size() != turns.size() || length.size() != turns.size() ||
      side.size() != turns.size() || all != turn.size() || joint.size() != turn.size())
    throw InputError("{}: the arrays of {}/ do not describe the same turns", file.path().string(), group);

  Turned digits;
  std::vector<double> curvature;
  std::array<std::vector<double>, 2> by_place;  // within arcs, and between them
  std::size_t at = 0;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    double sum = 0;
    for (std::int32_t k = 0; k < turns[i]; ++k, ++at) {
      const double degrees = std::abs(static_cast<double>(turn[at])) * 180 / std::numbers::pi;
      by_place[joint[at] ? 1 : 0].push_back(degrees);
      sum += degrees;
    }
    if (turns[i] == 0) continue;
    digits.turn.push_back(sum / turns[i]);
    digits.good.push_back(good[i]);
    curvature.push_back(sum * static_cast<double>(side[i]) / static_cast<double>(length[i]));
  }
  const std::string prefix = "digit_turns." + group;
  if (digits.turn.empty()) return digits;
  table.add(prefix + ".turn", replication, mean(digits.turn));
  table.add(prefix + ".curvature", replication, mean(curvature));
  for (const auto& [name, values] : {std::pair{".within", by_place[0]}, std::pair{".joints", by_place[1]}})
    if (!values.empty()) table.add(prefix + name, replication, mean(values));
  return digits;
}

// Digits with a turn of each replication, by repertoire.
using Replications = std::map<std::string, std::map<int, Turned>>;

// A12 of what one side has against what the other has, and an interval of three replications and more: they
// are drawn anew, since the digits of one have a network and layers in common.
using Sides = std::function<std::pair<std::vector<double>, std::vector<double>>(int replication)>;
void add_effect(StatisticsTable& table, const std::string& name, const std::vector<double>& replications,
                const Sides& sides) {
  std::map<int, std::pair<std::vector<double>, std::vector<double>>> known;
  for (const double r : replications) known.emplace(static_cast<int>(r), sides(static_cast<int>(r)));
  const auto effect = [&](std::span<const double> drawn, std::span<const double>) {
    std::vector<double> one, other;
    for (const double r : drawn) {
      const auto& [some, others] = known.at(static_cast<int>(r));
      one.insert(one.end(), some.begin(), some.end());
      other.insert(other.end(), others.begin(), others.end());
    }
    // A draw that lacks one side altogether tells nothing.
    return one.empty() || other.empty() ? 0.5 : effect_size(one, other);
  };
  std::size_t some = 0, others = 0;
  for (const auto& [r, pair] : known) some += pair.first.size(), others += pair.second.size();
  if (some == 0 || others == 0) return;
  table.number(name, effect(replications, {}));
  if (replications.size() < kFewestToTest) return;
  const Interval interval = bootstrap(replications, {}, effect, name);
  table.number(name + "_low", interval.low);
  table.number(name + "_high", interval.high);
}

}  // namespace

void read_turns(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  Replications found;
  std::vector<double> replications;
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    const int r = artifact.name.replication;
    replications.push_back(r);
    for (const std::string& group : file.children("/"))
      found[group].emplace(r, read_group(file, group, r, table));
  }
  for (const auto& [group, of_replications] : found) {
    const std::string prefix = "digit_turns." + group;
    std::vector<double> good, refused;
    for (const auto& [r, digits] : of_replications) {
      for (const double turn : digits.where(true)) good.push_back(turn);
      for (const double turn : digits.where(false)) refused.push_back(turn);
    }
    if (!good.empty()) table.box(prefix + ".of_good", good);
    if (!refused.empty()) table.box(prefix + ".of_refused", refused);
    add_effect(table, prefix + ".refused_turn_more", replications, [&](int r) {
      const auto digits = of_replications.find(r);
      return digits == of_replications.end()
                 ? std::pair<std::vector<double>, std::vector<double>>()
                 : std::pair(digits->second.where(false), digits->second.where(true));
    });
  }
  if (!found.contains("hbr") || !found.contains("flat")) return;
  add_effect(table, "digit_turns.flat_turn_more", replications, [&](int r) {
    const auto turns = [&](const char* group) {
      const auto digits = found.at(group).find(r);
      return digits == found.at(group).end() ? std::vector<double>() : digits->second.turn;
    };
    return std::pair(turns("flat"), turns("hbr"));
  });
}

}  // namespace hbr::inline statistics
