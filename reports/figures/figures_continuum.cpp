// A walk through the latent space, from class to class: what is drawn on the way (the paper's "continuum").
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "reports/figures/contender.h"
#include "reports/figures/drawings.h"
#include "reports/figures/figures.h"
#include "reports/plot/picture.h"

namespace hbr::inline reports {
namespace {

using Place = std::vector<double>;  // in the latent space

double distance(const Place& a, const Place& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum);
}

struct Centre {
  int label;
  Place place;
};

// The medians of the classes' test images.
std::vector<Centre> centres(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const auto position = file.read<float>("latent/position");
  const auto label = file.read<std::uint8_t>("latent/label").values;
  if (position.shape.size() != 2 || position.shape[0] != label.size() || position.shape[1] == 0)
    throw InputError("{}: latent/position does not hold a position per label", path.string());
  const std::size_t dim = position.shape[1];
  std::vector<Centre> result;
  for (int digit = 0; digit < 10; ++digit) {
    Centre centre{digit, {}};
    for (std::size_t k = 0; k < dim; ++k) {
      std::vector<double> values;
      for (std::size_t i = 0; i < label.size(); ++i)
        if (label[i] == digit) values.push_back(position.values[i * dim + k]);
      if (!values.empty()) centre.place.push_back(summarise(values, "latent position").median);
    }
    if (!centre.place.empty()) result.push_back(std::move(centre));
  }
  return result;
}

// The shortest way that visits all of them once (Held and Karp 1962), from whichever end comes first.
std::vector<Centre> shortest_way(const std::vector<Centre>& stops) {
  const std::size_t n = stops.size(), sets = std::size_t{1} << n;
  const double never = std::numeric_limits<double>::infinity();
  std::vector<std::vector<double>> length(sets, std::vector<double>(n, never));
  std::vector<std::vector<std::size_t>> before(sets, std::vector<std::size_t>(n, n));
  for (std::size_t i = 0; i < n; ++i) length[std::size_t{1} << i][i] = 0;
  for (std::size_t set = 1; set < sets; ++set)
    for (std::size_t last = 0; last < n; ++last)
      for (std::size_t next = 0; next < n && length[set][last] < never; ++next) {
        if (set >> next & 1) continue;
        const std::size_t more = set | std::size_t{1} << next;
        const double sum = length[set][last] + distance(stops[last].place, stops[next].place);
        if (sum < length[more][next]) length[more][next] = sum, before[more][next] = last;
      }
  std::vector<Centre> way;
  std::size_t set = sets - 1;
  std::size_t at = std::ranges::min_element(length[set]) - length[set].begin();
  while (at < n) {
    way.push_back(stops[at]);
    const std::size_t previous = before[set][at];
    set &= ~(std::size_t{1} << at);
    at = previous;
  }
  return way;
}

struct Walk {
  std::vector<Place> steps;          // evenly along the way
  std::vector<std::size_t> arrives;  // step nearest to each stop
};

Walk walk(const std::vector<Centre>& way, std::size_t steps) {
  std::vector<double> length{0};
  for (std::size_t i = 1; i < way.size(); ++i)
    length.push_back(length.back() + distance(way[i - 1].place, way[i].place));
  Walk result;
  for (std::size_t s = 0; s < steps; ++s) {
    const double at = length.back() * static_cast<double>(s) / static_cast<double>(steps - 1);
    std::size_t leg = 1;
    while (leg + 1 < way.size() && length[leg] < at) ++leg;
    const double share = (at - length[leg - 1]) / std::max(length[leg] - length[leg - 1], 1e-12);
    Place place = way[leg - 1].place;
    for (std::size_t k = 0; k < place.size(); ++k) place[k] += share * (way[leg].place[k] - place[k]);
    result.steps.push_back(place);
  }
  for (const double at : length)
    result.arrives.push_back(static_cast<std::size_t>(
        std::lround(at / std::max(length.back(), 1e-12) * static_cast<double>(steps - 1))));
  return result;
}

std::size_t nearest(const Drawings& drawings, const Place& place) {
  const std::size_t dim = drawings.measures.size() / drawings.size();
  std::size_t best = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < drawings.size(); ++i) {
    const float* at = &drawings.measures[i * dim];
    if (const double d = distance(place, {at, at + dim}); d < least) least = d, best = i;
  }
  return best;
}

}  // namespace

Figure continuum_figure(const Evidence& evidence) {
  Figure figure{.id = "continuum", .title = "From digit to digit"};
  figure.caption =
      "The shortest walk through the latent space that visits the median place of every class of the test "
      "images. At each step stands the nearest elite; the label of a class stands where the walk passes its "
      "median. First replication.";
  const auto files = evidence.artifacts.replications("digit_verdicts");
  auto networks = evidence.artifacts.replications("autoencoder");
  if (const std::string other = "descriptor.h5"; networks.empty() && evidence.artifacts.has(other))
    networks.push_back(evidence.artifacts.path(other));
  std::vector<Centre> way;
  if (!networks.empty() && !files.empty()) way = centres(networks[0]);
  if (way.size() < 2) {
    figure.absent = "This run has no digits in a latent space to walk through.";
    return figure;
  }
  constexpr std::size_t kSteps = 28;
  constexpr int kPixels = 84;
  constexpr double kEdge = 56, kWidth = 1232, kCell = (kWidth - kEdge) / kSteps, kTop = 24;
  way = shortest_way(way);
  const Walk steps = walk(way, kSteps);
  std::string body;
  std::map<std::size_t, std::string> labels;  // classes with the same place share a step
  for (std::size_t i = 0; i < way.size(); ++i) {
    std::string& label = labels[steps.arrives[i]];
    label += (label.empty() ? "" : ", ") + std::to_string(way[i].label);
  }
  std::string visited;
  for (const auto& [step, label] : labels) visited += (visited.empty() ? "" : ", ") + label;
  for (const auto& [step, label] : labels)
    body += svg_text(label, kEdge + (static_cast<double>(step) + 0.5) * kCell, 16, 16, Colour::ink,
                     Align::centre);
  double top = kTop;
  for (const char* who : {"hbr", "flat"}) {
    if (!has_drawings(files[0], who)) continue;
    const Drawings drawings = read_drawings(files[0], who);
    if (drawings.measures.size() / drawings.size() != way[0].place.size())
      throw InputError("{}: {}/measures has not the {} dimensions of the latent space; make it again",
                       files[0].string(), who, way[0].place.size());
    const Contender contender = hbr::contender(who);
    InkSheet sheet(static_cast<int>(kSteps) * kPixels, kPixels);
    for (std::size_t s = 0; s < kSteps; ++s) {
      const std::size_t i = nearest(drawings, steps.steps[s]);
      sheet.place(drawings.image(i), (static_cast<double>(s) + 0.5) * kPixels, 0.5 * kPixels, kPixels);
      figure.tables["walk"].add({{"series", contender.label},
                                 {"step", static_cast<double>(s)},
                                 {"class", static_cast<double>(drawings.label[i])},
                                 {"good", static_cast<double>(drawings.good[i])}});
    }
    body += sheet.svg_image(kEdge, top, kWidth - kEdge, kCell);
    body += svg_text(contender.label, 0, top + kCell / 2 + 5, 16, contender.colour, Align::left);
    top += kCell + 6;
  }
  figure.panels.push_back(
      {"A walk through the latent space",
       Drawing{kWidth, top, body,
               fmt::format("{} drawings in a row for the hierarchy and for the flat repertoire, "
                           "with the classes {} on the way.",
                           kSteps, visited)},
       6});
  return figure;
}

}  // namespace hbr::inline reports
