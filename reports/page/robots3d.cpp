#include "reports/page/robots3d.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "reports/figures/contender.h"
#include "reports/page/assets.h"
#include "reports/page/pack.h"

namespace hbr::inline reports {
namespace {

const std::string kShape = "_shape.h5";
constexpr double kJointStep = 4e-6;  // rad or m: half of it moves a pen by some micrometres
constexpr int kPlaces = 4095;        // steps along each side of a piece's box

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

// In 16 bits where all fit.
template <class T>
void integers(Pack& pack, const std::string& name, const std::vector<std::size_t>& shape,
              const std::vector<T>& values) {
  const bool small = values.empty() || std::ranges::max(values) < 65536;
  if (small)
    pack.array(name, shape, std::vector<std::uint16_t>(values.begin(), values.end()));
  else
    pack.array(name, shape, std::vector<std::int32_t>(values.begin(), values.end()));
}

// A part's or piece's own rows of an array.
template <class T>
std::vector<T> row(const Array<T>& array, std::size_t i) {
  const std::size_t columns = array.shape.at(1);
  const auto first = array.values.begin() + static_cast<std::ptrdiff_t>(i * columns);
  return {first, first + static_cast<std::ptrdiff_t>(columns)};
}

nlohmann::json parts_of(const Hdf5Reader& file) {
  const auto parent = file.read<std::int32_t>("part/parent"),
             coordinate = file.read<std::int32_t>("part/coordinate");
  const auto slides = file.read<std::uint8_t>("part/slides");
  const auto multiplier = file.read<double>("part/multiplier"), offset = file.read<double>("part/offset"),
             origin = file.read<double>("part/origin"), axis = file.read<double>("part/axis");
  nlohmann::json parts = nlohmann::json::array();
  for (std::size_t i = 0; i < parent.values.size(); ++i)
    parts.push_back({{"parent", parent.values[i]},
                     {"coordinate", coordinate.values[i]},
                     {"slides", slides.values[i] != 0},
                     {"multiplier", multiplier.values[i]},
                     {"offset", offset.values[i]},
                     {"origin", row(origin, i)},
                     {"axis", row(axis, i)}});
  return parts;
}

// Positions in steps of their piece's box, normals in 8 bits.
void add_pieces(Pack& pack, const Hdf5Reader& file) {
  const auto part = file.read<std::int32_t>("piece/part"),
             vertices = file.read<std::int32_t>("piece/vertices"),
             triangles = file.read<std::int32_t>("piece/triangles"),
             corner = file.read<std::int32_t>("triangle/vertex");
  const auto opacity = file.read<float>("piece/opacity"), colour = file.read<float>("piece/colour"),
             position = file.read<float>("vertex/position"), normal = file.read<float>("vertex/normal");
  nlohmann::json pieces = nlohmann::json::array();
  std::vector<std::uint16_t> places;
  std::size_t vertex = 0;
  for (std::size_t i = 0; i < part.values.size(); ++i) {
    const auto count = static_cast<std::size_t>(vertices.values[i]);
    std::vector<double> low(3, 0), high(3, 0);
    for (std::size_t k = 0; k < 3 * count; ++k) {
      const double value = position.values[3 * vertex + k];
      low[k % 3] = k < 3 ? value : std::min(low[k % 3], value);
      high[k % 3] = k < 3 ? value : std::max(high[k % 3], value);
    }
    for (std::size_t k = 0; k < 3 * count; ++k) {
      const double side = high[k % 3] - low[k % 3], value = position.values[3 * vertex + k] - low[k % 3];
      places.push_back(static_cast<std::uint16_t>(side > 0 ? std::lround(kPlaces * value / side) : 0));
    }
    vertex += count;
    pieces.push_back({{"part", part.values[i]},
                      {"vertices", vertices.values[i]},
                      {"triangles", triangles.values[i]},
                      {"colour", row(colour, i)},
                      {"opacity", opacity.values[i]},
                      {"low", low},
                      {"high", high}});
  }
  std::vector<std::uint8_t> directions;
  for (const float value : normal.values)
    directions.push_back(static_cast<std::uint8_t>(std::lround(128 + 127 * std::clamp(value, -1.f, 1.f))));
  pack.word("pieces", pieces);
  pack.word("places", kPlaces);
  pack.array("position", position.shape, places);
  pack.array("normal", normal.shape, directions);
  integers(pack, "triangle", corner.shape, corner.values);
}

std::string shape_pack(const std::string& robot, const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  Pack pack("robot-" + robot);
  const auto list = [&](const char* name) { return file.read<double>(name).values; };
  pack.word("lower", list("joint/lower"));
  pack.word("upper", list("joint/upper"));
  pack.word("pen_place", list("pen/place"));
  pack.word("joints", file.text_attribute("joints"));
  pack.word("pen_part", static_cast<int>(file.number_attribute("pen_part")));
  pack.word("half_side", file.number_attribute("half_side"));
  pack.word("plane", {{"origin", list("plane/origin")},
                      {"u", list("plane/u")},
                      {"v", list("plane/v")},
                      {"scale", file.number_attribute("plane_scale")}});
  pack.word("parts", parts_of(file));
  add_pieces(pack, file);
  return pack.html();
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

std::string three_pack(const std::filesystem::path& folder) {
  Pack pack("three");
  for (const auto& [name, file] : std::map<std::string, std::string>{
           {"controls", "OrbitControls.js"}, {"module", "three.module.min.js"}, {"licence", "LICENSE"}}) {
    const std::string text = read_whole(folder / file);
    pack.array(name, {text.size()}, std::vector<std::uint8_t>(text.begin(), text.end()));
  }
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
