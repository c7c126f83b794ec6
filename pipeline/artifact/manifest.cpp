#include "pipeline/artifact/manifest.h"

#include <algorithm>
#include <set>

#include "pipeline/artifact/json_file.h"
#include "pipeline/core/check.h"

namespace hbr::inline artifact {
namespace {

nlohmann::json ingredients_json(const Ingredients& from) {
  return {
      {"slice", from.slice}, {"program", from.program}, {"inputs", from.inputs}, {"sources", from.sources}};
}

// A record may have more than is known here (a later version's): numbers and texts all the same, or lists of
// texts.
void check_record(const nlohmann::json& run, const std::string& where) {
  const std::set<std::string> numbers{"seconds", "cpu_seconds", "waited_seconds", "peak_memory_bytes",
                                      "exit",    "threads",     "tries"};
  const std::set<std::string> texts{"started",      "host",      "launch", "version",  "compiler",
                                    "architecture", "processor", "flags",  "libraries"};
  for (const auto& [key, value] : run.items()) {
    if (key == "failures" && value.is_array() &&
        std::ranges::all_of(value, [](const nlohmann::json& each) { return each.is_string(); }))
      continue;
    const bool is_number = value.is_number() && value.get<double>() >= 0;
    if (texts.contains(key) ? value.is_string() : is_number || (value.is_string() && !numbers.contains(key)))
      continue;
    throw InputError("{}: run.{}: expected {}, found {}", where, key,
                     numbers.contains(key) ? "a number from 0"
                     : key == "failures"   ? "a list of texts"
                                           : "a text",
                     value.dump());
  }
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
  write_whole(path, sealed(settings_to_json(manifest)).dump(1) + "\n");
}

Manifest read_manifest(const std::filesystem::path& path) {
  const std::string where = path.string();
  nlohmann::json all = read_json(path);
  if (all.is_object() && all.contains("seal")) all = unsealed(std::move(all), where);  // older ones have none
  auto manifest = settings_from_json<Manifest>(all, where);
  manifest.slice = slice_from_json(manifest.made_from.slice, where + ": slice");
  check_record(manifest.run, where);
  if (manifest.made_from.key() != manifest.key)
    throw InputError("{}: key: expected {}, which is that of its ingredients, found {}", where,
                     manifest.made_from.key(), manifest.key);
  return manifest;
}

}  // namespace hbr::inline artifact
