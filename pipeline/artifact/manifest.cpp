#include "pipeline/artifact/manifest.h"

#include <fstream>

namespace hbr {
namespace {

nlohmann::json ingredients_json(const Ingredients& from) {
  return {
      {"slice", from.slice}, {"program", from.program}, {"inputs", from.inputs}, {"sources", from.sources}};
}

}  // namespace

std::string Ingredients::key() const { return sha256_of_text(ingredients_json(*this).dump()); }

std::string name_of(const Node& node) {
  const std::string ending = ".h5";
  std::string name = node.output;
  if (name.ends_with(ending)) name.resize(name.size() - ending.size());
  return name;
}

nlohmann::json slice_of(const Node& node) {
  nlohmann::json inputs = nlohmann::json::object();
  for (const auto& [name, output] : node.inputs) inputs[name] = output;
  nlohmann::json slice = {{"stage", node.stage},
                          {"name", name_of(node)},
                          {"settings", node.settings},
                          {"inputs", inputs},
                          {"output", node.output}};
  if (!node.variation.empty()) slice["variation"] = node.variation;
  return slice;
}

std::filesystem::path manifest_path(const std::filesystem::path& out, const Node& node) {
  return out / (name_of(node) + ".json");
}

void write_manifest(const std::filesystem::path& path, const Manifest& manifest) {
  nlohmann::json all = ingredients_json(manifest.made_from);
  all["key"] = manifest.key;
  all["sha256"] = manifest.content.sha256;
  all["files"] = manifest.content.files;
  all["bytes"] = manifest.content.bytes;
  all["sign"] = manifest.sign;
  all["run"] = manifest.run;
  write_whole(path, all.dump(1) + "\n");
}

std::optional<Manifest> read_manifest(const std::filesystem::path& path) {
  std::ifstream stream(path);
  if (!stream) return {};
  try {
    const nlohmann::json all = nlohmann::json::parse(stream);
    Manifest manifest;
    manifest.made_from.slice = all.at("slice");
    manifest.made_from.slice.at("settings");
    all.at("program").get_to(manifest.made_from.program);
    all.at("inputs").get_to(manifest.made_from.inputs);
    all.at("sources").get_to(manifest.made_from.sources);
    all.at("key").get_to(manifest.key);
    all.at("sha256").get_to(manifest.content.sha256);
    all.at("files").get_to(manifest.content.files);
    all.at("bytes").get_to(manifest.content.bytes);
    all.at("sign").get_to(manifest.sign);
    manifest.run = all.at("run");
    return manifest;
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

}  // namespace hbr
