#include "stages/plan/plan.h"

#include <algorithm>
#include <cctype>
#include <set>

#include "pipeline/qd/distance_archive.h"
#include "pipeline/statistics/names.h"

namespace hbr::inline stages {

// m; layer 1 is asked at each of the points of every line.
constexpr double kLeastLineSpacing = 1e-4;

nlohmann::json with(nlohmann::json settings, const nlohmann::json& more) {
  settings.update(more);
  return settings;
}

void check_name(const std::string& where, const std::string& table, const std::string& name) {
  const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits))
    throw InputError("{}: {}: name '{}': expected letters, digits and _", where, table, name);
}

Plan::Plan(const SettingsSource& source, std::string where)
    : profile_(settings_from_source<Profile>(source)), rows_(layer_rows(source)), where_(std::move(where)) {
  check();
}

void Plan::check() const {
  const auto check_names = [&](const char* table, const auto& variants) {
    std::set<std::string> seen;
    for (const auto& v : variants) {
      check_name(where_, table, v.name);
      if (!seen.insert(v.name).second) fail(fmt::format("{}: name '{}' stands twice", table, v.name));
    }
  };
  check_names("layers", rows_);
  for (const LayerRow& row : rows_)
    if (!can_be_a_layers_name(row.name))
      fail(
          fmt::format("layers: the name '{}' would be taken for that of another stage's results, or for a "
                      "goal of make's own; expected another",
                      row.name));
  check_names("robots", profile_.robots);
  check_names("searches.variants", profile_.searches.variants);
  if (std::ranges::find(profile_.robots, "arm", &RobotSettings::name) != profile_.robots.end())
    fail("robots: name 'arm' is the planar arm's; expected another");
  if (profile_.arm.links.empty()) fail("arm.links is empty; expected the length of one link at least");
  if (profile_.replications.digits > profile_.replications.lines)
    fail(
        fmt::format("replications.digits = {}: expected at most replications.lines ({}), whose layers the "
                    "digits are built on",
                    profile_.replications.digits, profile_.replications.lines));
  if (profile_.descriptor.kind == "onnx" && profile_.descriptor.file.empty())
    fail("descriptor: kind = 'onnx' with file = ''; expected the path of an ONNX network");
  if (const std::string fault = fault_of(profile_.descriptor.onnx); !fault.empty())
    fail(fmt::format("descriptor.onnx.{}", fault));
  for (const LayerRow& row : rows_) {
    const double line_spacing = row.settings.value("line_spacing", 0.0);
    if (line_spacing > 0 && line_spacing < kLeastLineSpacing)
      fail(fmt::format("layers.{}: line_spacing = {} m; expected 0 (at a line's end alone) or {} at least",
                       row.name, line_spacing, kLeastLineSpacing));
    const bool cells = row.search.container == "grid" || row.search.container == "cvt";
    const int dimensions = row.kind->name == std::string("numbers") && profile_.descriptor.kind != "onnx"
                               ? row.settings["digits"].get<int>() * profile_.autoencoder.latent_size
                               : 0;
    if (!cells && dimensions > kMostDimensions)
      fail(fmt::format(
          "layers.{}: {} digits in {} latent dimensions make descriptors of {}; the container {} has at "
          "most {}: fewer of either, another container, or leave_out = ['{}']",
          row.name, row.settings["digits"].get<int>(), profile_.autoencoder.latent_size, dimensions,
          row.search.container, kMostDimensions, row.name));
  }
  for (const LayerRow& row : rows_)
    if (row.settings.contains("pencil") &&
        row.settings["pencil"]["thinnest_px"] > row.settings["pencil"]["thickest_px"])
      fail(fmt::format("layers.{}: pencil: thinnest_px = {} exceeds thickest_px = {}", row.name,
                       row.settings["pencil"]["thinnest_px"].get<double>(),
                       row.settings["pencil"]["thickest_px"].get<double>()));
}

const LayerRow& Plan::layer(const std::string& name, const char* key, const char* kind) const {
  const auto found = std::ranges::find(rows_, name, &LayerRow::name);
  if (found == rows_.end()) {
    std::vector<std::string> names;
    for (const LayerRow& row : rows_)
      if (!kind || row.kind->name == std::string(kind)) names.push_back(row.name);
    fail(fmt::format("{} = '{}': expected the name of a layer ({})", key, name, fmt::join(names, ", ")));
  }
  if (kind && found->kind->name != std::string(kind))
    fail(fmt::format("{} = '{}': this layer is of kind {}; expected {}", key, name, found->kind->name, kind));
  return *found;
}

std::vector<const LayerRow*> Plan::stack(const std::string& name) const {
  std::vector<const LayerRow*> stack;
  for (std::string at = name; !at.empty(); at = stack.back()->below) stack.push_back(&layer(at, "below"));
  std::ranges::reverse(stack);
  return stack;
}

bool Plan::learned(const LayerRow& row) const {
  return std::ranges::any_of(stack(row.name), [](const LayerRow* r) { return r->kind->learned; });
}

int Plan::replications(const LayerRow& row) const {
  return learned(row) ? profile_.replications.digits : profile_.replications.lines;
}

std::pair<std::string, std::string> Plan::descriptor(int replication) const {
  return {"descriptor", own_networks() ? numbered("autoencoder", replication) : "descriptor.h5"};
}

Inputs Plan::inputs(const std::string& name, const std::vector<const LayerRow*>& stack,
                    int replication) const {
  Inputs inputs;
  for (const LayerRow* row : stack)
    inputs.emplace_back(fmt::format("{}{}", name, inputs.size() + 1), numbered(row->name, replication));
  return inputs;
}

void Plan::add_layer(const std::string& name, const LayerRow& row, int replication,
                     const nlohmann::json& body, Inputs below, std::vector<std::string> sources,
                     std::int64_t more) {
  if (row.kind->learned) below.push_back(descriptor(replication));
  SearchTable search = row.search;
  search.generations += more;
  add("layer", name, replication,
      with(run(replication), {{"kind", row.kind->name},
                              {"layer", row.settings},
                              {"body", row.kind->built_on_others() ? nlohmann::json::object() : body},
                              {"search", settings_to_json(search)},
                              {"more", more}}),
      std::move(below), std::move(sources));
}

void Plan::add_numbers(const std::string& name, Inputs stack, int replication,
                       std::vector<std::string> sources) {
  stack.insert(stack.end(), {{"dataset", "dataset.h5"}, {"judge", "judge.h5"}});
  add("numbers", name, replication, nlohmann::json::object(), std::move(stack), std::move(sources));
}

void Plan::add(const std::string& program, const std::string& stage, int replication, nlohmann::json settings,
               Inputs inputs, std::vector<std::string> sources) {
  const std::string output = replication < 0 ? stage + ".h5" : numbered(stage, replication);
  graph_.push_back(
      {program, stage, replication, output, std::move(settings), std::move(inputs), std::move(sources)});
}

}  // namespace hbr::inline stages
