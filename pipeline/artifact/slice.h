// A slice: what a stage program is told (OUT/.plan/slices/NAME.json), see FORMAT.md.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/artifact/graph.h"
#include "pipeline/core/settings.h"

namespace hbr::inline artifact {

struct Slice {
  std::string stage, name;
  nlohmann::json settings;
  std::map<std::string, std::string> inputs;  // name -> path below OUT
  std::string output;                         // below OUT
  std::string variation;                      // "" where it is of none
};

template <class Fields>
void describe(Fields& f, Slice& s) {
  f.text("stage", s.stage, "the program's task");
  f.text("name", s.name, "of this run");
  f.raw_table("settings", s.settings, "only what this run depends on");
  f.named_texts("inputs", s.inputs, "name -> path below the output folder");
  f.text("output", s.output, "path below the output folder");
  f.text("variation", s.variation, "whose run it is, or \"\"");
}

// Of a table that is in a manifest, or in the file that a stage is called with (which may hold what the
// runner needs besides). Throws InputError.
Slice slice_from_json(nlohmann::json table, const std::string& where);

std::filesystem::path slice_path(const std::filesystem::path& out, const Node& node);
// The slice with what the runner needs besides, as make's recipe hands it over.
void write_slice(const std::filesystem::path& out, const Node& node);
// Throws InputError where the file is not as write_slice left it.
Node read_slice(const std::filesystem::path& file);

}  // namespace hbr::inline artifact
