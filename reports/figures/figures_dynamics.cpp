// The digits replayed by the servos of robots: what is left of them, and how near the servos come to their
// limits.
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

const std::string kReplayed = "_dynamics";
constexpr std::size_t kImagePixels = 784;

// A digit in the rows of the picture: as it was, as the servos are asked for it, and what they drew.
struct ReplayRow {
  const char *group, *label;
  Colour colour;
};
constexpr std::array kReplayRows{
    ReplayRow{"", "before", Colour::ink}, ReplayRow{"wanted", "asked", Colour::grey},
    ReplayRow{"arm", "arm", Colour::blue}, ReplayRow{"whole", "body", Colour::orange}};

struct ReplayedDigit {
  std::array<std::vector<std::uint8_t>, kReplayRows.size()> images;  // some empty
  float difference;                                                  // of the arm's
};

std::vector<ReplayedDigit> read_replays(const std::vector<std::filesystem::path>& files) {
  std::vector<ReplayedDigit> digits;
  for (const auto& path : files) {
    const Hdf5Reader file(path);
    const std::vector<float> difference = file.read<float>("arm/absolute").values;
    const std::size_t first = digits.size();
    for (const float value : difference) digits.push_back({{}, value});
    for (std::size_t row = 0; row < kReplayRows.size(); ++row) {
      const std::string group = kReplayRows[row].group, name = group.empty() ? "image" : group + "/image";
      if (!file.has(name)) continue;
      const std::vector<std::uint8_t> images = file.read<std::uint8_t>(name).values;
      if (images.size() != kImagePixels * difference.size())
        throw InputError("{}: {} does not hold as many digits as arm/absolute, {}", path.string(), name,
                         difference.size());
      for (std::size_t i = 0; i < difference.size(); ++i) {
        const auto at = images.begin() + static_cast<std::ptrdiff_t>(i * kImagePixels);
        digits[first + i].images[row].assign(at, at + kImagePixels);
      }
    }
  }
  std::ranges::stable_sort(digits, {}, &ReplayedDigit::difference);
  return digits;
}

// Digits at even ranks of the arm's difference; rows that no digit has are left out.
std::vector<GalleryRow> gallery(const std::vector<ReplayedDigit>& digits) {
  const std::size_t shown = std::min(digits.size(), kGalleryColumns);
  std::vector<GalleryRow> rows;
  for (std::size_t row = 0; row < kReplayRows.size(); ++row) {
    if (digits[0].images[row].empty()) continue;
    rows.push_back({kReplayRows[row].label, kReplayRows[row].colour});
    for (std::size_t k = 0; k < shown; ++k)
      rows.back().images.push_back(
          digits[shown == 1 ? 0 : k * (digits.size() - 1) / (shown - 1)].images[row]);
  }
  return rows;
}

// The quantities of that prefix with the greatest medians.
std::vector<std::string> greatest(const StatisticsView& statistics, const std::string& prefix,
                                  std::size_t n) {
  std::vector<std::string> names = statistics.quantities(prefix);
  const auto median = [&](const std::string& name) {
    const auto box = statistics.box(name);
    return box ? box->all.median : 0.0;
  };
  std::ranges::stable_sort(names, std::greater<>(), median);
  names.resize(std::min(n, names.size()));
  return names;
}

// " NAO, medians of 345 digits: arm 0.0613 mm from its way, ...; body ..."
std::string measured_words(const StatisticsView& statistics, const std::string& name,
                           const std::string& robot) {
  std::string text;
  for (const auto& [player, words] : {std::pair<std::string, const char*>{"arm", "arm"}, {"whole", "body"}}) {
    const auto rms = statistics.box(name + player + "_rms"),
               torque = statistics.box(name + player + "_torque"),
               faster = statistics.box(name + player + "_faster");
    if (!rms || !torque || !faster) continue;
    text += text.empty() ? fmt::format(" {}, medians of {} digits:", escape_html(robot), rms->all.n) : ";";
    text += fmt::format(
        " {} {} mm (root mean square) from its way, at most {} of a torque limit, a limit reached "
        "at {} times the pace",
        words, format_number(rms->all.median), format_quantity(torque->all.median, "%"),
        format_number(faster->all.median));
    const auto margin = statistics.box(name + player + "_margin");
    if (margin)
      text +=
          fmt::format(", the centre of pressure {} mm inside the sole", format_number(margin->all.median));
    const std::vector<double> tips = statistics.quantity(name + player + "_tips");
    if (!tips.empty())
      text += fmt::format(", outside it in {} of the digits",
                          format_quantity(summarise(tips, player.c_str()).median, "%"));
  }
  return text.empty() ? "" : text + ".";
}

}  // namespace

Figure dynamics_figure(const Evidence& evidence, const std::string& id) {
  Figure figure{.id = id + kReplayed, .title = "The same digits by its servos, under gravity"};
  const auto files = evidence.artifacts.replications(id + kReplayed);
  if (files.empty()) {
    figure.absent = "No digit was replayed by the robot’s servos in this run.";
    return figure;
  }
  const std::string name = "dynamics." + id + ".";
  const std::vector<ReplayedDigit> digits = read_replays(files);
  if (digits.empty()) throw InputError("{} holds no digit", id + kReplayed);
  const auto add = [&](const std::vector<std::string>& names, BoxOptions options) {
    options.figure = figure.id;
    options.brackets = false;
    for (Panel& panel : pooled_box_panel(evidence.statistics, names, options, figure.tables))
      figure.panels.push_back(std::move(panel));
  };
  const auto of = [&](std::initializer_list<const char*> measures) {
    std::vector<std::string> names;
    for (const char* measure : measures) names.push_back(name + measure);
    return names;
  };
  figure.panels.push_back(gallery_panel("Digits", gallery(digits)));
  add(of({"elites_absolute", "wanted_absolute", "arm_absolute", "whole_absolute"}),
      {.title = "Difference per pixel", .unit = "% of white against black", .from_zero = true, .span = 3});
  add(of({"arm_rms", "arm_max", "whole_rms", "whole_max"}),
      {.title = "Distance from the way", .unit = "µm", .logarithmic = true, .scale = 1000});
  add(of({"arm_torque", "whole_torque", "arm_speed", "whole_speed"}),
      {.title = "Greatest load", .unit = "% of the limit", .from_zero = true});
  add(of({"arm_faster", "whole_faster"}),
      {.title = "Pace that reaches a limit", .unit = "times the profile’s", .from_zero = true});
  add(greatest(evidence.statistics, name + "arm_torque_of.", 5),
      {.title = "Torques of the drawing joints", .unit = "% of the limit", .from_zero = true, .span = 3});
  const auto body = greatest(evidence.statistics, name + "whole_torque_of.", 5);
  if (!body.empty())
    add(body,
        {.title = "Greatest torques of the body", .unit = "% of the limit", .from_zero = true, .span = 3});
  else
    add(greatest(evidence.statistics, name + "arm_speed_of.", 5),
        {.title = "Speeds of the drawing joints", .unit = "% of the limit", .from_zero = true, .span = 3});
  add(of({"whole_margin"}),
      {.title = "Centre of pressure inside the sole", .unit = "mm", .from_zero = true, .span = 3});
  add(of({"whole_grip"}),
      {.title = "Friction that the sole needs", .unit = "coefficient", .from_zero = true, .span = 3});
  figure.caption =
      "Some of the digits, replayed in a physical simulation with the masses, inertias and limits of the "
      "robot’s description. Before: straight from elite to elite. Asked: the smooth way of the joints that "
      "the "
      "servos are to follow, which turns them as little as the digit allows; elites: the same through layer "
      "1’s "
      "own postures, of which neighbours may hold the arm differently. Arm: the drawing joints under "
      "computed "
      "torque, all others locked. Body: all joints move; those that do not draw are held by springs and "
      "dampers, "
      "and one foot (or the base) stands still. Where a foot stands, the ground’s reaction must push within "
      "the hull of all that touches the floor at rest, both feet for NAO; below 0 the robot would tip. Loads "
      "are what the controller asked for; above 100 % it did "
      "not "
      "get it. The pace is that at which inverse dynamics reaches a limit of torque or speed. Whiskers: "
      "within "
      "1.5 interquartile ranges." +
      measured_words(evidence.statistics, name, robot_title(id));
  return figure;
}

}  // namespace hbr::inline reports
