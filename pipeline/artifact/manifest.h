// The manifest beside an artifact: what made it, from what, and what it holds. See FORMAT.md.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/graph.h"
#include "pipeline/artifact/slice.h"

namespace hbr::inline artifact {

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
  Slice slice;      // made_from's, when it was read
  std::string key;  // of made_from
  Content content;
  std::string fingerprint;                        // of the artifact when its content was hashed
  nlohmann::json run = nlohmann::json::object();  // times, host, version, ...: no part of the key
};

template <class Fields>
void describe(Fields& f, Manifest& m) {
  f.raw_table("slice", m.made_from.slice, "what the stage was given");
  f.text("program", m.made_from.program, "SHA-256");
  f.named_texts("inputs", m.made_from.inputs, "name -> SHA-256");
  f.texts("sources", m.made_from.sources, "SHA-256 of each");
  f.text("key", m.key, "SHA-256 of the four above");
  f.text("sha256", m.content.sha256, "of the artifact");
  f.named_texts("files", m.content.files, "of a folder: file -> SHA-256");
  f.number("bytes", m.content.bytes, Range{0, 1e18}, "of the artifact");
  f.text("sign", m.fingerprint, "of the artifact when its content was hashed");
  f.raw_table("run", m.run, "times, host, version, compiler");
}

// {stage, name, settings, inputs, output}, and variation where the node is of one.
nlohmann::json slice_of(const Node& node);
// "layer2_n10/03": the output without its ".h5".
std::string name_of(const Node& node);
// OUT/layer2_n10/03.json
std::filesystem::path manifest_path(const std::filesystem::path& out, const Node& node);

void write_manifest(const std::filesystem::path& path, const Manifest& manifest);
// Throws InputError where there is none or it is not as write_manifest left it: then nothing is known of the
// artifact.
Manifest read_manifest(const std::filesystem::path& path);

}  // namespace hbr::inline artifact
