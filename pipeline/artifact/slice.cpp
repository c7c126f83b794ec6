#include "pipeline/artifact/slice.h"

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/json_file.h"
#include "pipeline/artifact/manifest.h"
#include "pipeline/artifact/temporary.h"

namespace hbr::inline artifact {
namespace {

// What the runner knows of a node that its stage is not told.
struct ForRunner {
  std::string program;
  int replication = -1;
  std::vector<std::string> sources;
};

template <class Fields>
void describe(Fields& f, ForRunner& r) {
  f.text("program", r.program, "the stage program's name");
  f.number("replication", r.replication, Range{-1, 9999}, "-1 for a stage that has none");
  f.texts("sources", r.sources, "files that it reads besides");
}

nlohmann::json keys_of_runner(nlohmann::json& table) {
  nlohmann::json taken = nlohmann::json::object();
  for (const char* key : {"program", "replication", "sources"})
    if (const auto found = table.find(key); found != table.end()) {
      taken[key] = *found;
      table.erase(found);
    }
  return taken;
}

}  // namespace

Slice slice_from_json(nlohmann::json table, const std::string& where) {
  if (table.is_object()) {
    keys_of_runner(table);
    table.emplace("variation", "");
  }
  return settings_from_json<Slice>(table, where);
}

std::filesystem::path slice_path(const std::filesystem::path& out, const Node& node) {
  return out / ".plan/slices" / (name_of(node) + ".json");
}

void write_slice(const std::filesystem::path& out, const Node& node) {
  nlohmann::json all = slice_of(node);
  all.update(settings_to_json(ForRunner{node.program, node.replication, node.sources}));
  const std::filesystem::path path = slice_path(out, node);
  std::filesystem::create_directories(path.parent_path());
  const std::string text = all.dump(1) + "\n";
  if (std::filesystem::exists(path) && read_whole(path) == text) return;
  // A machine that stops may lose it, and the next plan writes it again: waiting for the disk would cost more
  // than all the rest of planning.
  const Temporary written(temporary_beside(path));
  write_file(written.path, text);
  std::filesystem::rename(written.path, path);
}

Node read_slice(const std::filesystem::path& file) {
  nlohmann::json all = read_json(file);
  const Slice slice = slice_from_json(all, file.string());
  const auto more = settings_from_json<ForRunner>(keys_of_runner(all), file.string());
  return {more.program, slice.stage,    more.replication,
          slice.output, slice.settings, {slice.inputs.begin(), slice.inputs.end()},
          more.sources, slice.variation};
}

}  // namespace hbr::inline artifact
