// Fine-tuning: what lines, arcs and digits gain when their layers evolve on over another robot.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "reports/figures/contender.h"
#include "reports/figures/figures.h"
#include "reports/figures/gallery.h"
#include "reports/figures/panels.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

const std::string kTuned = "_tuned";
constexpr std::size_t kPixels = 784;

// The states of a robot's layers, as files and statistics call them.
constexpr std::array kStates{"before", "top", "all"};

// An arm's digit, and for each state the robot's that is nearest to its place in the latent space.
struct TunedDigit {
  std::vector<std::uint8_t> arm;
  std::array<std::vector<std::uint8_t>, kStates.size()> robot;
  float difference;  // of arm and before
};

std::vector<std::uint8_t> image(const std::filesystem::path& path, const std::vector<std::uint8_t>& images,
                                std::size_t i) {
  if ((i + 1) * kPixels > images.size())
    throw InputError("{}: digit {} is not among {}", path.string(), i, images.size() / kPixels);
  const auto at = images.begin() + static_cast<std::ptrdiff_t>(i * kPixels);
  return {at, at + kPixels};
}

// Those that differed most first.
std::vector<TunedDigit> read_digits(const std::vector<std::filesystem::path>& files) {
  std::vector<TunedDigit> digits;
  for (const auto& path : files) {
    const Hdf5Reader file(path);
    const std::size_t first = digits.size();
    const auto arm = file.read<std::uint8_t>("arm/image").values;
    for (const float difference : file.read<float>("before/absolute").values)
      digits.push_back({image(path, arm, digits.size() - first), {}, difference});
    for (std::size_t s = 0; s < kStates.size(); ++s) {
      const std::string state = kStates[s];
      const auto images = file.read<std::uint8_t>(state + "/image").values;
      const auto nearest = file.read<std::int32_t>(state + "/nearest").values;
      if (nearest.size() != digits.size() - first)
        throw InputError("{}: {}/nearest and before/absolute differ in length", path.string(), state);
      for (std::size_t i = 0; i < nearest.size(); ++i)
        digits[first + i].robot[s] = image(path, images, static_cast<std::size_t>(nearest[i]));
    }
  }
  std::ranges::stable_sort(digits, std::greater<>(), &TunedDigit::difference);
  return digits;
}

Panel worst_panel(const std::vector<TunedDigit>& digits) {
  std::vector<GalleryRow> rows{{"arm", Colour::blue}};
  for (const char* state : kStates) rows.push_back({contender(state).label, contender(state).colour});
  for (std::size_t k = 0; k < std::min(kGalleryColumns, digits.size()); ++k) {
    rows[0].images.push_back(digits[k].arm);
    for (std::size_t s = 0; s < kStates.size(); ++s) rows[s + 1].images.push_back(digits[k].robot[s]);
  }
  return gallery_panel("Places where it differed most", rows);
}

}  // namespace

Figure tuned_figure(const Evidence& evidence, const std::string& id) {
  Figure figure{.id = id + kTuned, .title = "Fine-tuning: the arm’s layers evolve on over this robot"};
  const auto files = evidence.artifacts.replications(id + kTuned);
  if (files.empty()) {
    figure.absent = "The arm’s layers did not evolve on over the robot in this run.";
    return figure;
  }
  const std::string robot = robot_title(id), name = "tuned." + id + ".", arm = "tuned.arm.";
  figure.panels.push_back(worst_panel(read_digits(files)));
  const auto options = [&](const std::string& title, const char* unit, double scale, int span) {
    return BoxOptions{.title = title,
                      .unit = unit,
                      .figure = figure.id,
                      .from_zero = scale == 1000,
                      .scale = scale,
                      .span = span};
  };
  const auto add = [&](std::vector<Panel> panels) {
    for (Panel& panel : panels) figure.panels.push_back(std::move(panel));
  };
  const auto of_digits = [&](const std::string& measure) {
    return std::vector<std::string>{arm + "before." + measure, name + "before." + measure,
                                    name + "top." + measure, name + "all." + measure};
  };
  const char* const fitness = "minus the squared error per pixel";
  add(pooled_box_panel(
      evidence.statistics,
      {arm + "top.difference", name + "before.difference", name + "top.difference", name + "all.difference"},
      options("Difference from the arm’s digit at its place", "% of white against black", 1, 3),
      figure.tables));
  add(box_panel(evidence.statistics, of_digits("mean"), options("Mean fitness of the digits", fitness, 1, 2),
                figure.tables));
  add(box_panel(evidence.statistics, of_digits("good"),
                options("Share of good digits", "% of the digits", 100, 2), figure.tables));
  add(box_panel(evidence.statistics,
                {arm + "top.gain", name + "top.gain", arm + "all.gain", name + "all.gain"},
                options("Gain, and the arm’s", fitness, 1, 2), figure.tables));
  add(pooled_box_panel(evidence.statistics,
                       {arm + "before.arc_fitness", name + "before.arc_fitness", name + "all.arc_fitness"},
                       options("Fitness of arcs, from fresh starts", "no unit", 1, 3), figure.tables));
  for (const auto& [measure, title] :
       {std::pair<std::string, const char*>{"line", "Lines, from what was asked"},
        {"arc_centre", "Centres of arcs, from what was asked"},
        {"arc_length", "Lengths of arcs, from what was asked"}})
    add(pooled_box_panel(evidence.statistics,
                         {arm + "before." + measure, name + "before." + measure, name + "all." + measure},
                         options(title, "mm of the arm", 1000, 3), figure.tables));
  figure.caption =
      "The arm’s layers continue to evolve for some generations with the robot in the arm’s place. Arm: the "
      "arm’s layers on the arm; before: the same by the robot; layer 4: the digits continued over the arm’s "
      "lines and arcs; all: lines, arcs and digits continued, each over the one below. As a control, we "
      "continued evolving the arm’s own layers for as long. For each of the arm’s digits we compare the "
      "robot’s "
      "nearest digit in latent space; before, that is the same genome as a rule. Good is what the judge "
      "says; a "
      "gain is the mean fitness above that before. Lines and arcs are asked for at places near those that "
      "the "
      "arm’s repertoires hold; what is left on the arm is how far one execution is from the median of many "
      "that "
      "a descriptor is. p: rank-sum test over the replications.";
  const auto gain = evidence.statistics.quantity(name + "top.gain"),
             control = evidence.statistics.quantity(arm + "top.gain");
  if (!gain.empty() && !control.empty())
    figure.caption += fmt::format(" {}: layer 4 alone gains {} where the arm’s gains {} (medians).",
                                  escape_html(robot), format_number(summarise(gain, "gain").median),
                                  format_number(summarise(control, "gain").median));
  return figure;
}

}  // namespace hbr::inline reports
