#include "reports/page/robots3d.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "reports/figures/contender.h"
#include "reports/page/assets.h"
#include "reports/page/pack.h"
#include "reports/page/shape_pack.h"

namespace hbr::inline reports {
namespace {

const std::string kShape = "_shape.h5";
constexpr double kJointStep = 4e-6;  // rad or m: half of it moves a pen by some micrometres

// Names of the robots, NAO first and the arm last.
std::vector<std::string> shown_robots(const Artifacts& artifacts) {
  std::vector<std::string> names;
  for (const std::string& file : artifacts.ending(kShape))
    names.push_back(file.substr(0, file.size() - kShape.size()));
  std::ranges::stable_sort(names, {}, [](const std::string& name) {
    return name == "nao" ? 0 : name == "arm" ? 2 : 1;
  });
  return names;
}

// Of each digit 1 where servos replayed it, and then 2 where it left the board, 4 where a joint's limit was
// passed, 8 where it can't be read any more: of the whole body where there is one.
std::vector<std::uint8_t> servos(const Artifacts& artifacts, const std::string& name,
                                 const std::vector<std::int64_t>& id) {
  std::vector<std::uint8_t> bits(id.size());
  if (!artifacts.has(name)) return bits;
  const Hdf5Reader file(artifacts.path(name));
  const std::string player = file.has("whole/lost") ? "whole" : "arm";
  const auto replayed = file.read<std::int64_t>("id").values;
  const auto off_board = file.read<std::uint8_t>(player + "/off_board").values,
             beyond = file.read<std::uint8_t>(player + "/beyond_limit").values,
             lost = file.read<std::uint8_t>(player + "/lost").values;
  for (std::size_t i = 0; i < replayed.size(); ++i) {
    const auto row = std::ranges::find(id, replayed[i]) - id.begin();
    if (row < static_cast<std::ptrdiff_t>(id.size()))
      bits[static_cast<std::size_t>(row)] =
          static_cast<std::uint8_t>(1 + 2 * off_board[i] + 4 * beyond[i] + 8 * lost[i]);
  }
  return bits;
}

std::string ways_pack(const Artifacts& artifacts, const std::string& robot, const std::string& replication,
                      const std::filesystem::path& path) {
  const Hdf5Reader file(path), transfer(artifacts.path(robot + "_transfer/" + replication + ".h5"));
  const auto id = file.read<std::int64_t>("id").values;
  if (transfer.read<std::int64_t>("id").values != id)
    throw InputError("{}: holds other digits than {}; make it again", path.string(),
                     transfer.path().string());
  Pack pack(fmt::format("ways-{}-{}", robot, replication));
  const auto points = file.read<std::int32_t>("points"), way = file.read<std::int32_t>("way");
  integers(pack, "points", points.shape, points.values);
  integers(pack, "way", way.shape, way.values);
  const auto joints = file.read<float>("joints"), absolute = transfer.read<float>("absolute");
  std::vector<std::int32_t> steps;
  for (const float joint : joints.values)
    steps.push_back(static_cast<std::int32_t>(std::lround(joint / kJointStep)));
  pack.word("step", kJointStep);
  pack.array("joints", joints.shape, steps);
  pack.array("absolute", absolute.shape, absolute.values);
  const auto smooth = file.read<std::uint8_t>("smooth");
  pack.array("smooth", smooth.shape, smooth.values);
  pack.array("servos", {id.size()},
             servos(artifacts, fmt::format("{}_dynamics/{}.h5", robot, replication), id));
  return pack.html();
}

// Replications whose digits the explorer brings along, and every robot but the arm its ways.
std::vector<std::string> shown_replications(const Artifacts& artifacts,
                                            const std::vector<std::string>& robots) {
  std::vector<std::string> names;
  for (const std::filesystem::path& path : artifacts.replications("explorer")) {
    const std::string name = path.stem().string();
    if (std::ranges::all_of(robots, [&](const std::string& robot) {
          return robot == "arm" || artifacts.has(robot + "_ways/" + name + ".h5");
        }))
      names.push_back(name);
  }
  return names;
}

}  // namespace

std::string robots_3d_packs(const Artifacts& artifacts, const std::filesystem::path& three) {
  const std::vector<std::string> robots = shown_robots(artifacts),
                                 replications = shown_replications(artifacts, robots);
  if (three.empty() || robots.empty() || replications.empty()) return "";
  nlohmann::json listed = nlohmann::json::array();
  std::string html;
  for (const std::string& robot : robots) {
    listed.push_back({{"name", robot}, {"title", robot == "arm" ? "Planar arm" : robot_title(robot)}});
    html += shape_pack(robot, artifacts.path(robot + kShape));
    if (robot == "arm") continue;  // the explorer has its ways
    for (const std::string& r : replications)
      html += ways_pack(artifacts, robot, r, artifacts.path(robot + "_ways/" + r + ".h5"));
  }
  Pack list("robots3d");
  list.word("robots", listed);
  list.word("replications", replications);
  return list.html() + html + three_pack(three);
}

std::string robots_3d_html(const Artifacts& artifacts, const std::filesystem::path& three) {
  const std::vector<std::string> robots = shown_robots(artifacts);
  if (robots.empty() || shown_replications(artifacts, robots).empty()) return "";
  if (three.empty())
    return "<p class=\"absent\">When this page was made three.js could not be had: it shows the robots by "
           "pictures "
           "alone.</p>\n";
  return kRobots3dHtml;
}

}  // namespace hbr::inline reports
