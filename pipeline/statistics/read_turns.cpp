// Are arcs, not abrupt angles, the reason why the judge accepts more digits of one repertoire than of
// another?
#include <array>
#include <cmath>
#include <numbers>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/inference.h"
#include "pipeline/statistics/rank_sum.h"
#include "pipeline/statistics/readers.h"
#include "pipeline/statistics/summary.h"

namespace hbr::inline statistics {
namespace {

// Digits with a turn, of one replication or of all.
struct Turned {
  std::vector<double> turn;  // degrees, mean of a digit's turns without their sense
  std::vector<std::uint8_t> good;

  void append(const Turned& more) {
    turn.insert(turn.end(), more.turn.begin(), more.turn.end());
    good.insert(good.end(), more.good.begin(), more.good.end());
  }
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

void add_interval(StatisticsTable& table, const std::string& name, double value, const Interval& interval) {
  table.number(name, value);
  table.number(name + "_low", interval.low);
  table.number(name + "_high", interval.high);
}

}  // namespace

void read_turns(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  std::map<std::string, Turned> pooled;
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    for (const std::string& group : file.children("/"))
      pooled[group].append(read_group(file, group, artifact.name.replication, table));
  }
  for (const auto& [group, digits] : pooled) {
    const std::vector<double> good = digits.where(true), refused = digits.where(false);
    const std::string prefix = "digit_turns." + group;
    if (!good.empty()) table.box(prefix + ".of_good", good);
    if (!refused.empty()) table.box(prefix + ".of_refused", refused);
    const std::string name = prefix + ".refused_turn_more";
    if (!good.empty() && !refused.empty())
      add_interval(table, name, effect_size(refused, good), bootstrap(refused, good, effect_size, name));
  }
  const auto hbr = pooled.find("hbr"), flat = pooled.find("flat");
  if (hbr == pooled.end() || flat == pooled.end() || hbr->second.turn.empty() || flat->second.turn.empty())
    return;
  const std::string name = "digit_turns.flat_turn_more";
  add_interval(table, name, effect_size(flat->second.turn, hbr->second.turn),
               bootstrap(flat->second.turn, hbr->second.turn, effect_size, name));
}

}  // namespace hbr::inline statistics
