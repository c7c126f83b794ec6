// Fine-tuning: what the digits gain when they evolve on over another robot.
#include <fmt/format.h>

#include <algorithm>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "reports/contender.h"
#include "reports/figures.h"
#include "reports/gallery.h"
#include "reports/panels.h"

namespace hbr {
namespace {

const std::string kSuffix = "_tuned";
constexpr std::size_t kPixels = 784;

// An arm's digit, and the robot's that is nearest to its place in the latent space.
struct Digit {
  std::vector<std::uint8_t> arm, before, after;
  float difference;  // of arm and before
};

std::vector<Digit> read_digits(const std::vector<std::filesystem::path>& files) {
  std::vector<Digit> digits;
  for (const auto& path : files) {
    const Hdf5Reader file(path);
    const auto arm = file.read<std::uint8_t>("arm/image").values,
               before = file.read<std::uint8_t>("before/image").values,
               after = file.read<std::uint8_t>("after/image").values;
    const auto difference = file.read<float>("before/absolute").values;
    const auto at_before = file.read<std::int32_t>("before/nearest").values,
               at_after = file.read<std::int32_t>("after/nearest").values;
    const auto image = [&](const std::vector<std::uint8_t>& images, std::size_t i) {
      if ((i + 1) * kPixels > images.size())
        throw InputError("{}: digit {} is not among {}", path.string(), i, images.size() / kPixels);
      const auto at = images.begin() + static_cast<std::ptrdiff_t>(i * kPixels);
      return std::vector<std::uint8_t>(at, at + kPixels);
    };
    if (at_before.size() != difference.size() || at_after.size() != difference.size())
      throw InputError("{}: before/nearest, after/nearest and before/absolute differ in length",
                       path.string());
    for (std::size_t i = 0; i < difference.size(); ++i)
      digits.push_back({image(arm, i), image(before, static_cast<std::size_t>(at_before[i])),
                        image(after, static_cast<std::size_t>(at_after[i])), difference[i]});
  }
  std::ranges::stable_sort(digits, std::greater<>(), &Digit::difference);
  return digits;
}

}  // namespace

Figure tuned_figure(const Evidence& evidence) {
  Figure figure{.id = "tuned", .title = "Fine-tuning: the digits evolve on over the robot."};
  const auto stages = evidence.artifacts.stages("", kSuffix);
  if (stages.empty()) {
    figure.absent = "This run fine-tuned no digits.";
    return figure;
  }
  for (const std::string& stage : stages) {
    const std::string id = stage.substr(0, stage.size() - kSuffix.size()), robot = robot_title(id),
                      name = "tuned." + id + ".";
    const std::vector<Digit> digits = read_digits(evidence.artifacts.replications(stage));
    std::vector<GalleryRow> rows{
        {"arm", Colour::blue}, {"before", Colour::vermilion}, {"after", Colour::green}};
    for (std::size_t k = 0; k < std::min(kGalleryColumns, digits.size()); ++k) {
      rows[0].images.push_back(digits[k].arm);
      rows[1].images.push_back(digits[k].before);
      rows[2].images.push_back(digits[k].after);
    }
    figure.panels.push_back(gallery_panel(robot + ": places where it differed most", rows));
    const auto options = [&](const char* title, const char* unit, double scale) {
      return BoxOptions{
          .title = robot + ": " + title, .unit = unit, .figure = figure.id, .scale = scale, .span = 3};
    };
    const auto add = [&](std::vector<Panel> panels) {
      for (Panel& panel : panels) figure.panels.push_back(std::move(panel));
    };
    add(pooled_box_panel(
        evidence.statistics, {name + "before.difference", name + "after.difference"},
        options("difference from the arm’s digit at its place", "% of white against black", 1),
        figure.table));
    add(box_panel(evidence.statistics, {name + "arm.mean", name + "before.mean", name + "after.mean"},
                  options("mean fitness", "fitness", 1), figure.table));
    add(box_panel(evidence.statistics, {name + "arm.good", name + "before.good", name + "after.good"},
                  options("share of good digits", "% of elites", 100), figure.table));
  }
  figure.caption =
      "Layer 4 goes on for some generations with the robot in the arm’s place, from the arm’s digits. Arm: "
      "the "
      "digits as the arm draws them; before: the same genomes by the robot; after: the robot’s repertoire in "
      "the "
      "end. Places are those of the arm’s digits in the latent space: at each stands the robot’s digit that "
      "is "
      "nearest, and how much its pixels differ from the arm’s. Fitness is minus the network’s error; good is "
      "what "
      "the judge says. p: rank-sum test over the replications.";
  return figure;
}

}  // namespace hbr
