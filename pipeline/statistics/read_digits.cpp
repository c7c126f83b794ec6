#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/rank_correlation.h"
#include "pipeline/statistics/readers.h"
#include "pipeline/statistics/summary.h"

namespace hbr::inline statistics {
namespace {

constexpr double kCell = 0.1;  // side of a cell of the latent square [-1, 1]^2
constexpr int kCells = 20;     // a side
constexpr std::size_t kClasses = 10;
constexpr int kGoodNeeded = 3;  // good images for a class to count as present: one may be luck

struct Digits {
  std::size_t n = 0, dim = 0, pixels = 0;
  std::vector<std::uint8_t> image;  // [n x pixels]
  std::vector<float> measures;      // [n x dim]
  std::vector<float> objective, confidence, distance;
  std::vector<std::uint8_t> label, good;
};

Digits read_group(const Hdf5Reader& file, const std::string& group) {
  const Array<std::uint8_t> image = file.read<std::uint8_t>(group + "/image");
  Digits d;
  d.n = image.shape.empty() ? 0 : image.shape[0];
  d.image = image.values;
  const Array<float> measures = file.read<float>(group + "/measures");
  d.measures = measures.values;
  d.dim = measures.shape.size() == 2 ? measures.shape[1] : 0;
  d.objective = file.read<float>(group + "/objective").values;
  d.confidence = file.read<float>(group + "/confidence").values;
  d.distance = file.read<float>(group + "/distance").values;
  d.label = file.read<std::uint8_t>(group + "/label").values;
  d.good = file.read<std::uint8_t>(group + "/good").values;
  if (d.n == 0 || d.dim == 0 || d.measures.size() != d.dim * d.n || d.objective.size() != d.n ||
      d.confidence.size() != d.n || d.distance.size() != d.n || d.label.size() != d.n || d.good.size() != d.n)
    throw InputError("{}: the arrays of {}/ differ in length or are empty", file.path().string(), group);
  if (std::ranges::any_of(d.label, [](std::uint8_t c) { return c >= kClasses; }))
    throw InputError("{}: {}/label has a class above 9", file.path().string(), group);
  d.pixels = d.image.size() / d.n;
  return d;
}

// Share of the cells of the latent square that hold an elite; of a latent space of more dimensions the square
// of its first two.
double cells(const Digits& d) {
  const auto cell = [&](float z) {
    return std::clamp(static_cast<int>(std::floor((static_cast<double>(z) + 1) / kCell)), 0, kCells - 1);
  };
  std::set<int> held;
  for (std::size_t i = 0; i < d.n; ++i) {
    const float* z = &d.measures[d.dim * i];
    held.insert(d.dim == 1 ? cell(z[0]) : cell(z[0]) * kCells + cell(z[1]));
  }
  return static_cast<double>(held.size()) / (d.dim == 1 ? kCells : kCells * kCells);
}

std::size_t latent_neighbour(const Digits& d, std::size_t of) {
  std::size_t nearest = of;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < d.n; ++i) {
    double square = 0;
    for (std::size_t k = 0; k < d.dim; ++k) {
      const double gap = d.measures[d.dim * i + k] - d.measures[d.dim * of + k];
      square += gap * gap;
    }
    if (i != of && square < least) least = square, nearest = i;
  }
  return nearest;
}

// Mean absolute difference of a pixel between images and their latent neighbours, 1 is white against black:
// of all, and of those whose neighbour is of another class, where there are such.
void add_neighbours(const std::string& prefix, int replication, const Digits& d, StatisticsTable& table) {
  double all = 0, across = 0;
  std::size_t borders = 0;
  for (std::size_t i = 0; i < d.n; ++i) {
    const std::size_t j = latent_neighbour(d, i);
    double sum = 0;
    for (std::size_t p = 0; p < d.pixels; ++p)
      sum += std::abs(d.image[i * d.pixels + p] - d.image[j * d.pixels + p]);
    all += sum;
    if (d.label[i] != d.label[j]) across += sum, ++borders;
  }
  const auto mean_of = [&](double sum, std::size_t n) {
    return sum / 255 / static_cast<double>(n * d.pixels);
  };
  table.add(prefix + ".neighbour_difference", replication, mean_of(all, d.n));
  if (borders > 0) table.add(prefix + ".border_difference", replication, mean_of(across, borders));
}

// The same over all pairs, by counting grey values pixel by pixel: between neighbouring grey values lies the
// border that every pair with one image on either side has to cross.
double pair_difference(const Digits& d) {
  double sum = 0;
  for (std::size_t p = 0; p < d.pixels; ++p) {
    std::array<double, 256> count{};
    for (std::size_t i = 0; i < d.n; ++i) count[d.image[i * d.pixels + p]] += 1;
    double below = 0;
    for (std::size_t grey = 0; grey + 1 < count.size(); ++grey) {
      below += count[grey];
      sum += below * (static_cast<double>(d.n) - below);
    }
  }
  const double pairs = 0.5 * static_cast<double>(d.n) * static_cast<double>(d.n - 1);
  return sum / 255 / (pairs * static_cast<double>(d.pixels));
}

void add_judgement(const std::string& prefix, int replication, const Digits& d, StatisticsTable& table) {
  std::array<int, kClasses> good{}, seen{};
  for (std::size_t i = 0; i < d.n; ++i) {
    seen[d.label[i]] += 1;
    good[d.label[i]] += d.good[i] ? 1 : 0;
  }
  const auto add_share = [&](const char* name, std::size_t first, std::size_t last) {
    int goods = 0, all = 0;
    for (std::size_t c = first; c <= last; ++c) goods += good[c], all += seen[c];
    if (all > 0) table.add(prefix + name, replication, static_cast<double>(goods) / all);
  };
  add_share(".good", 0, 9);
  add_share(".good_01", 0, 1);
  add_share(".good_others", 2, 9);
  table.add(prefix + ".classes", replication,
            static_cast<double>(std::ranges::count_if(good, [](int g) { return g >= kGoodNeeded; })));
  if (const int all = std::accumulate(good.begin(), good.end(), 0); all > 0)
    table.add(prefix + ".rarest", replication,
              static_cast<double>(std::ranges::min(good)) * kClasses / static_cast<double>(all));
  for (std::size_t c = 0; c < kClasses; ++c) {
    table.add(fmt::format("{}.good_of_class.{}", prefix, c), replication, good[c]);
    table.add(fmt::format("{}.all_of_class.{}", prefix, c), replication, seen[c]);
  }
}

}  // namespace

void read_digits(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    const int replication = artifact.name.replication;
    for (const std::string& group : file.children("/")) {
      const Digits d = read_group(file, group);
      const std::string prefix = "digit_verdicts." + group;
      table.add(prefix + ".cells", replication, cells(d));
      add_judgement(prefix, replication, d, table);
      table.add(prefix + ".confidence", replication,
                mean(std::vector<double>(d.confidence.begin(), d.confidence.end())));
      table.add(prefix + ".distance", replication,
                summarise({d.distance.begin(), d.distance.end()}, prefix.c_str()).median);
      double reach = 0;
      for (const float z : d.measures) reach = std::max(reach, std::abs(static_cast<double>(z)));
      table.add(prefix + ".reach", replication, reach);
      if (d.n < 2) continue;
      table.add(prefix + ".agreement", replication,
                rank_correlation(std::vector<double>(d.objective.begin(), d.objective.end()),
                                 std::vector<double>(d.confidence.begin(), d.confidence.end())));
      add_neighbours(prefix, replication, d, table);
      table.add(prefix + ".pair_difference", replication, pair_difference(d));
    }
  }
}

}  // namespace hbr::inline statistics
