#include "stages/layers/read_stack.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/json_file.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/core/check.h"
#include "pipeline/hierarchy/layers.h"
#include "stages/layers/body.h"

namespace hbr::inline stages {
namespace {

nlohmann::json settings_of(const std::filesystem::path& artifact) {
  const Hdf5Reader file(artifact);
  const std::string where = artifact.string() + ": settings";
  nlohmann::json settings = parse_json(file.text_attribute("settings"), where);
  if (!settings.is_object() || !settings.contains("kind") || !settings["kind"].is_string() ||
      !settings.contains("layer"))
    throw InputError("{}: expected those of a layer, its kind and its settings; make it again", where);
  return settings;
}

}  // namespace

int StackOnBody::level(const std::string& kind) const {
  const auto found = std::ranges::find(kinds, kind);
  if (found == kinds.end())
    throw InputError("the stack of {} has no layer of {}", fmt::join(kinds, ", "), kind);
  return static_cast<int>(found - kinds.begin());
}

StoredLayer read_layer(const StageRun& stage, const std::string& name, StackOnBody& below,
                       const Descriptor* descriptor) {
  const std::filesystem::path artifact = stage.input(name);
  const nlohmann::json settings = settings_of(artifact);
  const LayerKind& kind = layer_kind(settings["kind"].get<std::string>());
  if (!below.body)
    below.body = make_body(settings.value("body", nlohmann::json::object()), artifact.string(), stage);
  if (!below.kinds.empty() && !kind.stands_on(layer_kind(below.kinds.back())))
    throw InputError("{}: {} command {}; below are {}", artifact.string(), kind.name, kind.asks,
                     below.kinds.back());
  StoredLayer layer{kind.name, read_elites(artifact), nullptr};
  layer.model = kind.make(settings["layer"], artifact.string() + ": settings.layer",
                          {*below.body, kind.built_on_others() ? &below.stack : nullptr, descriptor});
  const GenomeShape genome = layer.model->genome();
  if (layer.elites.solution.cols() != genome.genes() || layer.elites.length.empty() != genome.fixed())
    throw InputError("{}: genomes of {} genes; expected {}, as {} on {} have", artifact.string(),
                     layer.elites.solution.cols(), genome.genes(), kind.name, below.body->name());
  return layer;
}

void add_layer(StackOnBody& stack, StoredLayer layer) {
  stack.stack.add(std::move(layer.model), layer.elites);
  stack.kinds.push_back(layer.kind);
  stack.elites.push_back(std::move(layer.elites));
}

StackOnBody read_stack(const StageRun& stage, const std::string& name, const Descriptor* descriptor) {
  StackOnBody stack;
  int level = 1;
  do {
    add_layer(stack, read_layer(stage, fmt::format("{}{}", name, level), stack, descriptor));
  } while (stage.has_input(fmt::format("{}{}", name, ++level)));
  return stack;
}

}  // namespace hbr::inline stages
