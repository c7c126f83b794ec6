// Are the classes rare in a repertoire that the network takes for others, or those that it has seen little
// of?
#include <algorithm>
#include <numeric>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/class_confusion.h"
#include "pipeline/statistics/inference.h"
#include "pipeline/statistics/rank_correlation.h"
#include "pipeline/statistics/readers.h"

namespace hbr::inline statistics {
namespace {

using OfClasses = std::array<double, kDigitClasses>;

// Over the replications, class by class.
struct Means {
  OfClasses confused{}, cut{};
  std::map<std::string, OfClasses> good;
};

void add_network(const Artifact& artifact, Means& means, ClassCounts& pooled, StatisticsTable& table) {
  const Hdf5Reader file(artifact.path);
  const ClassCounts counts = nearest_classes(file.read<float>("latent/position").values,
                                             file.read<std::uint8_t>("latent/label").values);
  const std::vector<double> kept = file.read<double>("training/kept_per_class").values;
  if (kept.size() != kDigitClasses)
    throw InputError("{}: training/kept_per_class has {} values; expected {}", file.path().string(),
                     kept.size(), kDigitClasses);
  for (std::size_t c = 0; c < kDigitClasses; ++c) {
    const double all = std::accumulate(counts[c].begin(), counts[c].end(), 0.0);
    const double confused = all > 0 ? 1 - counts[c][c] / all : 0;
    table.add(fmt::format("autoencoder.confused_of_class.{}", c), artifact.name.replication, confused);
    means.confused[c] += confused;
    means.cut[c] += 1 - kept[c];
    for (std::size_t k = 0; k < kDigitClasses; ++k) pooled[c][k] += counts[c][k];
  }
}

// Share of the good digits that are of each class; nothing where none is good.
void add_digits(const Artifact& artifact, Means& means) {
  const Hdf5Reader file(artifact.path);
  for (const std::string& group : file.children("/")) {
    const auto label = file.read<std::uint8_t>(group + "/label").values,
               good = file.read<std::uint8_t>(group + "/good").values;
    if (label.size() != good.size())
      throw InputError("{}: {}/label has {} digits and {}/good {}; expected as many", file.path().string(),
                       group, label.size(), group, good.size());
    const auto all = static_cast<double>(std::ranges::count_if(good, [](std::uint8_t g) { return g != 0; }));
    for (std::size_t i = 0; i < label.size() && all > 0; ++i)
      if (good[i] && label[i] < kDigitClasses) means.good[group][label[i]] += 1 / all;
  }
}

// Rank correlation over the classes; its interval is over drawing the classes anew.
void add_correlation(const std::string& name, const OfClasses& what, const OfClasses& good,
                     StatisticsTable& table) {
  const Effect effect = [&](std::span<const double> classes, std::span<const double>) {
    std::vector<double> a, b;
    for (const double c : classes) {
      a.push_back(what[static_cast<std::size_t>(c)]);
      b.push_back(good[static_cast<std::size_t>(c)]);
    }
    return rank_correlation(a, b);
  };
  std::vector<double> classes(kDigitClasses);
  std::iota(classes.begin(), classes.end(), 0);
  const Interval interval = bootstrap(classes, {}, effect, name);
  table.number(name, effect(classes, {}));
  table.number(name + "_low", interval.low);
  table.number(name + "_high", interval.high);
}

}  // namespace

void read_confusion(const std::vector<Artifact>& networks, const std::vector<Artifact>& digits,
                    StatisticsTable& table) {
  Means means;
  ClassCounts pooled{};
  for (const Artifact& artifact : networks) add_network(artifact, means, pooled, table);
  if (networks.empty()) return;
  for (std::size_t c = 0; c < kDigitClasses; ++c) {
    pooled[c][c] = -1;
    const auto most = std::ranges::max_element(pooled[c]);
    if (*most > 0)
      table.number(fmt::format("autoencoder.taken_for.{}", c), static_cast<double>(most - pooled[c].begin()));
  }
  for (const Artifact& artifact : digits) add_digits(artifact, means);
  for (const auto& [group, good] : means.good) {
    add_correlation(fmt::format("digit_verdicts.{}.good_if_confused", group), means.confused, good, table);
    add_correlation(fmt::format("digit_verdicts.{}.good_if_cut", group), means.cut, good, table);
  }
}

}  // namespace hbr::inline statistics
