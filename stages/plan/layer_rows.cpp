#include "stages/plan/layer_rows.h"

#include <algorithm>
#include <map>
#include <set>

#include "pipeline/artifact/profile.h"
#include "pipeline/core/check.h"

namespace hbr::inline stages {
namespace {

using nlohmann::json;

std::set<std::string> keys_of_search() {
  std::set<std::string> keys;
  const json search = settings_to_json(SearchTable{});
  for (const auto& [key, value] : search.items()) keys.insert(key);
  return keys;
}

std::set<std::string> keys_of(const LayerKind& kind) {
  const std::vector<std::string> keys = kind.keys();
  std::set<std::string> all = keys_of_search();
  all.insert(keys.begin(), keys.end());
  return all;
}

class RowReader {
 public:
  explicit RowReader(const SettingsSource& profile) : profile_(profile) {
    check_defaults();
    std::set<std::string> left_out;
    for (const json& name : profile_.values.at("leave_out")) {
      left_out.insert(name.get<std::string>());
      if (!layers().contains(name.get<std::string>()))
        fail("/leave_out", fmt::format("there is no layer '{}'{}", name.get<std::string>(),
                                       did_you_mean(name.get<std::string>(), names())));
    }
    for (const auto& [name, table] : layers().items())
      if (!left_out.contains(name)) rows_.emplace(name, row(name, table));
  }

  std::vector<LayerRow> in_order() {
    std::vector<LayerRow> result;
    std::set<std::string> done;
    while (done.size() < rows_.size()) {
      const std::size_t before = done.size();
      for (const auto& [name, row] : rows_)
        if (!done.contains(name) && (row.below.empty() || done.contains(row.below))) {
          result.push_back(row);
          done.insert(name);
        }
      if (done.size() > before) continue;
      for (const auto& [name, row] : rows_)
        if (!rows_.contains(row.below) && !row.below.empty())
          fail("/leave_out", fmt::format("layer '{}' is left out, but '{}' is built on it", row.below, name));
      for (const auto& [name, row] : rows_)
        if (!done.contains(name))
          fail("/layers/" + name + "/below",
               fmt::format("layer '{}' stands on itself, by way of '{}'", name, row.below));
    }
    return result;
  }

 private:
  const json& layers() const { return profile_.values.at("layers"); }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& [name, table] : layers().items()) all.push_back(name);
    return all;
  }

  [[noreturn]] void fail(const std::string& pointer, const std::string& what) const {
    for (const auto* positions : {&profile_.keys, &profile_.places})
      if (const auto at = positions->find(pointer); at != positions->end())
        throw InputError("{}:{}:{}: {}", at->second.file, at->second.line, at->second.column, what);
    throw InputError("{}: {}", profile_.file, what);
  }

  const json& table(const std::string& pointer, const json& value) const {
    if (!value.is_object()) fail(pointer, "expected a table");
    return value;
  }

  // A key of [defaults] is one of some kind of layer, a key of [defaults.KIND] one of that kind.
  void check_defaults() const {
    std::set<std::string> known = keys_of_search();
    for (const LayerKind& kind : layer_kinds()) known.merge(keys_of(kind));
    for (const auto& [key, value] : profile_.values.at("defaults").items()) {
      const std::string pointer = "/defaults/" + key;
      const auto kind = std::ranges::find(layer_kinds(), key, &LayerKind::name);
      if (kind == layer_kinds().end() && !known.contains(key))
        fail(pointer, fmt::format("defaults.{} is neither a key nor a kind of layers{}", key,
                                  did_you_mean(key, {known.begin(), known.end()})));
      if (kind != layer_kinds().end())
        for (const auto& [inner, ignored] : table(pointer, value).items())
          check_key(pointer + "/" + inner, *kind, inner);
    }
  }

  void check_key(const std::string& pointer, const LayerKind& kind, const std::string& key) const {
    const std::set<std::string> known = keys_of(kind);
    if (!known.contains(key))
      fail(pointer, fmt::format("{} have no key '{}'{}; they have {}", kind.name, key,
                                did_you_mean(key, {known.begin(), known.end()}), fmt::join(known, ", ")));
  }

  std::string text(const std::string& pointer, const json& table, const char* key) const {
    if (!table.contains(key)) return "";
    if (!table[key].is_string())
      fail(pointer + "/" + key, fmt::format("{}: expected a name, found {}", key, table[key].dump()));
    return table[key].get<std::string>();
  }

  const LayerKind& kind_of(const std::string& pointer, const json& table) const {
    const std::string name = text(pointer, table, "kind");
    if (name.empty()) {
      const std::string layer = pointer.substr(pointer.rfind('/') + 1);
      std::vector<std::string> others = names();
      std::erase(others, layer);
      fail(pointer, fmt::format("layer '{}' says no kind{}; a layer of your own needs one of {}", layer,
                                did_you_mean(layer, others), fmt::join(names_of(layer_kinds()), ", ")));
    }
    const auto kind = std::ranges::find(layer_kinds(), name, &LayerKind::name);
    if (kind == layer_kinds().end())
      fail(pointer + (table.contains("kind") ? "/kind" : ""),
           fmt::format("kind '{}' of layer: expected one of {}", name,
                       fmt::join(names_of(layer_kinds()), ", ")));
    return *kind;
  }

  LayerRow row(const std::string& name, const json& own) const {
    check_name(profile_.file, "layers", name);
    const std::string pointer = "/layers/" + name;
    table(pointer, own);
    LayerRow row{name, &kind_of(pointer, own), text(pointer, own, "below"), {}, {}};
    if (row.kind->built_on_others() != !row.below.empty())
      fail(pointer,
           row.below.empty()
               ? fmt::format("layer '{}' says no layer below, which {} are built on", name, row.kind->name)
               : fmt::format("layer '{}' is built on '{}', but {} move the joints themselves", name,
                             row.below, row.kind->name));
    if (!row.below.empty() && !layers().contains(row.below))
      fail(pointer + "/below", fmt::format("layer '{}' is built on '{}', which is not there{}", name,
                                           row.below, did_you_mean(row.below, names())));
    if (!row.below.empty()) check_below(pointer, row);
    for (const auto& [key, value] : own.items())
      if (key != "kind" && key != "below") check_key(pointer + "/" + key, *row.kind, key);

    const SettingsSource all = gathered(*row.kind, pointer);
    row.search = settings_from_source<SearchTable>(only(all, keys_of_search()));
    const std::vector<std::string> keys = row.kind->keys();
    row.settings = row.kind->checked(only(all, {keys.begin(), keys.end()}));
    return row;
  }

  void check_below(const std::string& pointer, const LayerRow& row) const {
    const LayerKind& below = kind_of("/layers/" + row.below, layers()[row.below]);
    if (!row.kind->stands_on(below))
      fail(pointer + "/below",
           fmt::format("layer '{}' is of {}, which command {}; '{}' answers to {}", row.name, row.kind->name,
                       row.kind->asks, row.below, below.answers));
  }

  // Defaults and the layer's own keys laid over each other.
  SettingsSource gathered(const LayerKind& kind, const std::string& pointer) const {
    const std::set<std::string> keys = keys_of(kind);
    SettingsSource all = only(part_of(profile_, "/defaults"), keys);
    if (profile_.values.at("defaults").contains(kind.name))
      all = laid_over(std::move(all), part_of(profile_, std::string("/defaults/") + kind.name));
    return laid_over(std::move(all), only(part_of(profile_, pointer), keys));
  }

  static SettingsSource only(SettingsSource source, const std::set<std::string>& keys) {
    json kept = json::object();
    for (const auto& [key, value] : source.values.items())
      if (keys.contains(key)) kept[key] = value;
    source.values = std::move(kept);
    return source;
  }

  const SettingsSource& profile_;
  std::map<std::string, LayerRow> rows_;
};

}  // namespace

std::vector<LayerRow> layer_rows(const SettingsSource& profile) { return RowReader(profile).in_order(); }

}  // namespace hbr::inline stages
