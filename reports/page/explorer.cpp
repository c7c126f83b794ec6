#include "reports/page/explorer.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "pipeline/artifact/unit_columns.h"
#include "pipeline/core/check.h"
#include "reports/page/pack.h"

namespace hbr::inline reports {
namespace {

constexpr const char *kStage = "explorer", *kLinks = "links";

nlohmann::json columns(const Hdf5Reader& file, const std::string& array) {
  const UnitColumns c = read_unit_columns(file.path(), array);
  return {{"names", c.names}, {"units", c.units}, {"low", c.low},
          {"high", c.high},   {"from", c.from},   {"to", c.to}};
}

// Integers in 32 bits, or in 16 where all fit and `small` says so: there -1, which stands for none, becomes
// the greatest.
template <class T>
void integers(Pack& pack, const Hdf5Reader& file, const std::string& name, bool small) {
  const Array<T> array = file.read<T>(name);
  const T most = array.values.empty() ? 0 : std::ranges::max(array.values);
  if (most > std::numeric_limits<std::int32_t>::max())
    throw InputError("{}: {}: {} does not fit into 32 bits", file.path().string(), name, most);
  if (small && most < std::numeric_limits<std::uint16_t>::max())
    pack.array(name, array.shape, std::vector<std::uint16_t>(array.values.begin(), array.values.end()));
  else
    pack.array(name, array.shape, std::vector<std::int32_t>(array.values.begin(), array.values.end()));
}

template <class T>
void copy(Pack& pack, const Hdf5Reader& file, const std::string& name) {
  const Array<T> array = file.read<T>(name);
  pack.array(name, array.shape, array.values);
}

// Images [n x 28 x 28] in steps of `step`: decoded ones are smooth, and half as large in steps of 8. Elites
// that draw several are seen by their ways alone, which takes a third of the bytes.
void images(Pack& pack, const Hdf5Reader& file, const std::string& name, int step) {
  Array<std::uint8_t> array = file.read<std::uint8_t>(name);
  if (array.shape.size() != 3) return;
  for (std::uint8_t& value : array.values) value = static_cast<std::uint8_t>(value / step * step);
  pack.array(name, array.shape, array.values);
}

void add_layer(Pack& pack, const Hdf5Reader& file, const std::string& group, nlohmann::json& layers) {
  for (const std::string& name : file.children(group)) {
    const std::string array = group + "/" + name;
    if (name == "id" || name == "parent")
      integers<std::int64_t>(pack, file, array, false);
    else if (name == "way" || name == "points" || name == "stops" || name == "length")
      integers<std::int32_t>(pack, file, array, true);
    else if (name == "image" || name == "decoded")
      images(pack, file, array, name == "decoded" ? 8 : 1);
    else if (name == "label" || name == "good")
      copy<std::uint8_t>(pack, file, array);
    else
      copy<float>(pack, file, array);
  }
  const ValueMeaning fitness = read_value_meaning(file.path(), group + "/objective");
  nlohmann::json layer = {{"group", group},
                          {"batch", file.number_attribute(group + ".batch")},
                          {"genes", columns(file, group + "/solution")},
                          {"descriptor", columns(file, group + "/measures")},
                          {"fitness", {{"meaning", fitness.meaning}, {"units", fitness.units}}}};
  for (const std::string text : {"layer", "kind", "pen", "start"})
    if (file.has_attribute(group + "." + text)) layer[text] = file.text_attribute(group + "." + text);
  layers.push_back(std::move(layer));
}

std::string pack_of(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  Pack pack(fmt::format("{}-{}", kStage, path.stem().string()));
  nlohmann::json layers = nlohmann::json::array();
  for (const std::string& group : file.children("/"))
    if (group != kLinks) add_layer(pack, file, group, layers);
  pack.word("layers", layers);
  pack.word("half_side", file.number_attribute("half_side"));
  if (file.has(kLinks)) pack.word(kLinks, file.read<float>(kLinks).values);
  return pack.html();
}

}  // namespace

std::string explorer_packs(const Artifacts& artifacts, const std::string& profile) {
  const std::vector<std::filesystem::path> replications = artifacts.replications(kStage);
  if (replications.empty()) return "";
  std::vector<std::string> names;
  std::string html;
  for (const std::filesystem::path& path : replications) {
    names.push_back(path.stem().string());
    html += pack_of(path);
  }
  Pack list(kStage);
  list.word("replications", names);
  list.word("profile", profile);
  return list.html() + html;
}

std::string explorer_html(const Artifacts& artifacts) {
  if (artifacts.replications(kStage).empty())
    return "<p class=\"absent\">This run has no digits to explore.</p>\n";
  return "<p class=\"absent\" id=\"explorer-needs\">The explorer needs scripts and a browser that inflates "
         "data "
         "(DecompressionStream).</p>\n<div id=\"explorer-app\" hidden></div>\n";
}

}  // namespace hbr::inline reports
