// What the explorer shows of a run against the run itself: ways draw the stored images, decoded images are as
// far from the drawn ones as the fitness says, executions obey, and the page has all of it.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include "pipeline/artifact/unit_columns.h"
#include "pipeline/drawing/draw.h"
#include "tests/support/unpacked.h"

namespace hbr {

class ExpectedExplorer {
 public:
  explicit ExpectedExplorer(const std::filesystem::path& out)
      : out_(out), file_(out / "explorer/00.h5"), links_(file_.read<float>("links").values) {}

  void expect() {
    expect_same_as_layers();
    for (const char* group : {"hbr", "flat"}) {
      SCOPED_TRACE(group);
      expect_decoded(group);
      expect_verdicts(group);
    }
    expect_ways_draw_images("hbr", 1);
    expect_ways_draw_images("layer5", 2);
    expect_flat_genomes_draw_images();
    expect_lines_obey();
    EXPECT_EQ(file_.read<std::int32_t>("layer3/stops").shape[2], 6u);
  }

  // The page's packs hold what the artifact holds.
  void expect_page(const std::string& page) {
    EXPECT_EQ(Unpacked(page, "explorer").header.at("words").at("replications"), nlohmann::json({"00"}));
    const Unpacked pack(page, "explorer-00");
    std::set<std::string> groups;
    for (const auto& layer : pack.header.at("words").at("layers")) {
      const std::string group = layer.at("group");
      groups.insert(group);
      EXPECT_EQ(layer.at("genes").at("names"), read_unit_columns(file_.path(), group + "/solution").names);
      EXPECT_EQ(layer.at("descriptor").at("from"), read_unit_columns(file_.path(), group + "/measures").from);
      EXPECT_EQ(pack.read<float>(group + "/measures"), file_.read<float>(group + "/measures").values);
      EXPECT_EQ(pack.read<std::int32_t>(group + "/parent").size(),
                file_.read<std::int64_t>(group + "/id").values.size());
    }
    EXPECT_EQ(groups, (std::set<std::string>{"layer1", "layer2", "layer3", "hbr", "layer5", "flat"}));
    EXPECT_EQ(pack.read<std::uint8_t>("flat/image"), file_.read<std::uint8_t>("flat/image").values);
    const auto way = pack.read<std::uint16_t>("hbr/way");
    EXPECT_EQ((std::vector<std::int32_t>{way.begin(), way.end()}),
              file_.read<std::int32_t>("hbr/way").values);
  }

 private:
  template <class T>
  void expect_same(const Hdf5Reader& layer, const std::string& group, const std::string& name) {
    EXPECT_EQ(file_.has(group + "/" + name), layer.has(name)) << group << "/" << name;
    if (!layer.has(name)) return;
    EXPECT_EQ(file_.read<T>(group + "/" + name).values, layer.read<T>(name).values) << group << "/" << name;
  }
  void expect_same_as_layers() {
    const std::pair<const char*, const char*> layers[] = {{"layer1", "layer1"},   {"layer2", "layer2_n10"},
                                                          {"layer3", "layer3_b"}, {"hbr", "layer4"},
                                                          {"layer5", "layer5"},   {"flat", "flat_digits"}};
    for (const auto& [group, name] : layers) {
      const Hdf5Reader layer(out_ / name / "00.h5");
      EXPECT_EQ(file_.text_attribute(group + std::string(".layer")), name);
      for (const char* array : {"id", "parent"}) expect_same<std::int64_t>(layer, group, array);
      for (const char* array : {"solution", "measures", "objective", "uncertainty"})
        expect_same<float>(layer, group, array);
      expect_same<std::int32_t>(layer, group, "length");
      expect_same<std::uint8_t>(layer, group, "image");
    }
  }

  // Decoded is stored in steps of 1/255, as the image is.
  void expect_decoded(const std::string& group) {
    const auto image = file_.read<std::uint8_t>(group + "/image").values,
               decoded = file_.read<std::uint8_t>(group + "/decoded").values;
    const auto fitness = file_.read<float>(group + "/objective").values;
    ASSERT_EQ(decoded.size(), fitness.size() * kImagePixels);
    for (std::size_t i = 0; i < fitness.size(); ++i) {
      double sum = 0;
      for (std::size_t p = i * kImagePixels; p < (i + 1) * kImagePixels; ++p)
        sum += std::pow((image[p] - decoded[p]) / 255.0, 2);
      EXPECT_NEAR(sum / kImagePixels, -fitness[i], 0.001) << i;
    }
  }

  void expect_verdicts(const std::string& group) {
    const Hdf5Reader judged(out_ / "digit_verdicts/00.h5");
    for (const char* array : {"label", "good"})
      EXPECT_EQ(file_.read<std::uint8_t>(group + "/" + array).values,
                judged.read<std::uint8_t>(group + "/" + array).values);
    EXPECT_EQ(file_.read<float>(group + "/confidence").values,
              judged.read<float>(group + "/confidence").values);
  }

  // A gene or coordinate in its unit, as FORMAT.md says.
  double in_units(const std::string& array, std::size_t row, std::size_t column) {
    if (!columns_.contains(array))
      columns_[array] = {file_.read<float>(array), read_unit_columns(file_.path(), array)};
    const auto& [stored, c] = columns_[array];
    return c.from[column] + (stored.values[row * stored.shape[1] + column] - c.low) / (c.high - c.low) *
                                (c.to[column] - c.from[column]);
  }
  // Where the arm's pen is with joints that are columns `first` ... of a genome.
  std::pair<float, float> tip(const std::string& array, std::size_t row, std::size_t first) {
    double x = 0, y = 0, angle = 0;
    for (std::size_t j = 0; j < links_.size(); ++j) {
      angle += in_units(array, row, first + j);
      x += links_[j] * std::cos(angle);
      y += links_[j] * std::sin(angle);
    }
    return {static_cast<float>(x), static_cast<float>(y)};
  }
  void expect_drawn(const std::vector<float>& pen, double width, const std::uint8_t* stored) const {
    std::vector<float> image(kImagePixels);
    draw(pen.data(), static_cast<Eigen::Index>(pen.size() / 2), width, Framing::box, 1, image.data());
    std::vector<std::uint8_t> bytes(kImagePixels);
    image_to_bytes(image.data(), bytes.data());
    int worst = 0;
    for (int p = 0; p < kImagePixels; ++p) worst = std::max(worst, std::abs(bytes[p] - stored[p]));
    EXPECT_LE(worst, 1);  // sums of angles are rounded elsewhere
  }

  void expect_ways_draw_images(const std::string& group, std::size_t strokes) {
    SCOPED_TRACE(group);
    const auto way = file_.read<std::int32_t>(group + "/way").values;
    const auto points = file_.read<std::int32_t>(group + "/points");
    const auto image = file_.read<std::uint8_t>(group + "/image").values;
    ASSERT_EQ(points.shape[1], strokes);
    std::size_t at = 0;
    for (std::size_t k = 0; k < points.values.size(); ++k) {
      std::vector<float> pen;
      for (std::int32_t p = 0; p < points.values[k]; ++p, ++at) {
        const auto [x, y] = tip("layer1/solution", static_cast<std::size_t>(way[at]), 0);
        pen.insert(pen.end(), {x, y});
      }
      // Of numbers the width is a gene of the digit that answers, so any that draws the image will do.
      if (strokes == 1) expect_drawn(pen, in_units(group + "/solution", k, 2), &image[k * kImagePixels]);
      EXPECT_GT(points.values[k], 0);
    }
    EXPECT_EQ(std::accumulate(points.values.begin(), points.values.end(), std::size_t{0}), way.size());
  }

  void expect_flat_genomes_draw_images() {
    const auto image = file_.read<std::uint8_t>("flat/image").values;
    const auto length = file_.read<std::int32_t>("flat/length").values;
    EXPECT_EQ(file_.text_attribute("flat.pen"), "straight");
    EXPECT_EQ(file_.text_attribute("flat.start"), "first");
    for (std::size_t i = 0; i < std::min<std::size_t>(length.size(), 20); ++i) {
      std::vector<float> pen;
      for (auto at = std::size_t{1}; at < static_cast<std::size_t>(length[i]); at += links_.size()) {
        const auto [x, y] = tip("flat/solution", i, at);
        pen.insert(pen.end(), {x, y});
      }
      expect_drawn(pen, in_units("flat/solution", i, 0), &image[i * kImagePixels]);
    }
  }

  // A line ends at the point of layer 1 that is nearest to its start displaced by what its genome asks for.
  void expect_lines_obey() {
    const auto stops = file_.read<std::int32_t>("layer2/stops");
    const auto place = file_.read<float>("layer1/measures").values;
    const double side = 2 * file_.number_attribute("half_side");
    ASSERT_EQ(stops.shape[1], 5u);
    ASSERT_EQ(stops.shape[2], 2u);
    std::set<std::int32_t> starts;
    for (std::size_t i = 0; i < std::min<std::size_t>(stops.shape[0], 20); ++i) {
      double dx = in_units("layer2/solution", i, 0), dy = in_units("layer2/solution", i, 1);
      const double most = read_unit_columns(file_.path(), "layer2/solution").to[0], norm = std::hypot(dx, dy);
      if (norm > most) dx *= most / norm, dy *= most / norm;
      for (std::size_t e = 0; e < 5; ++e) {
        const auto from = static_cast<std::size_t>(stops.values[(i * 5 + e) * 2]),
                   to = static_cast<std::size_t>(stops.values[(i * 5 + e) * 2 + 1]);
        starts.insert(static_cast<std::int32_t>(from));
        const double x = place[2 * from] + dx / side, y = place[2 * from + 1] + dy / side;
        double least = 1e9;
        for (std::size_t p = 0; p < place.size() / 2; ++p)
          least = std::min(least, std::hypot(place[2 * p] - x, place[2 * p + 1] - y));
        EXPECT_NEAR(std::hypot(place[2 * to] - x, place[2 * to + 1] - y), least, 1e-6) << i;
      }
    }
    EXPECT_GT(starts.size(), 20u);
  }

  std::filesystem::path out_;
  Hdf5Reader file_;
  std::vector<float> links_;
  struct Columns {
    Array<float> stored;
    UnitColumns units;
  };
  std::map<std::string, Columns> columns_;
};

}  // namespace hbr
