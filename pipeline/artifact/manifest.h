// The manifest beside an artifact: what made it, from what, and what it holds. See FORMAT.md.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/graph.h"

namespace hbr {

// What an artifact is made from; equal ingredients, equal artifact. Threads, times and hosts are not among
// them.
struct Ingredients {
  nlohmann::json slice;                       // as slice_of() gives it
  std::string program;                        // sha256
  std::map<std::string, std::string> inputs;  // name -> sha256
  std::vector<std::string> sources;           // sha256, in the node's order

  std::string key() const;
};

struct Manifest {
  Ingredients made_from;
  std::string key;  // of made_from
  Content content;
  std::string sign;    // of the artifact when its content was hashed
  nlohmann::json run;  // times, host, version, compiler, ...: no part of the key
};

// {stage, name, settings, inputs, output}, and variation where the node is of one.
nlohmann::json slice_of(const Node& node);
// "layer2_n10/03": the output without its ".h5".
std::string name_of(const Node& node);
// OUT/layer2_n10/03.json
std::filesystem::path manifest_path(const std::filesystem::path& out, const Node& node);

void write_manifest(const std::filesystem::path& path, const Manifest& manifest);
// Nothing where there is none or it can't be understood: then nothing is known of the artifact.
std::optional<Manifest> read_manifest(const std::filesystem::path& path);

}  // namespace hbr
