#include "reports/page/shape_pack.h"

#include <cmath>
#include <map>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/hdf5_file.h"

namespace hbr::inline reports {
namespace {

constexpr int kPlaces = 4095;  // steps along each side of a piece's box

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

}  // namespace

std::string shape_pack(const std::string& robot, const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  Pack pack("robot-" + robot);
  const auto list = [&](const char* name) { return file.read<double>(name).values; };
  pack.word("lower", list("joint/lower"));
  pack.word("upper", list("joint/upper"));
  pack.word("joints", file.text_attribute("joints"));
  if (file.has("plane/origin")) {
    pack.word("pen_place", list("pen/place"));
    pack.word("pen_part", static_cast<int>(file.number_attribute("pen_part")));
    pack.word("half_side", file.number_attribute("half_side"));
    pack.word("plane", {{"origin", list("plane/origin")},
                        {"u", list("plane/u")},
                        {"v", list("plane/v")},
                        {"scale", file.number_attribute("plane_scale")}});
  }
  pack.word("parts", parts_of(file));
  add_pieces(pack, file);
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

}  // namespace hbr::inline reports
