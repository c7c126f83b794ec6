// Which artifacts are as the graph says they should be, decided by content alone: time stamps never matter.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/artifact/graph.h"
#include "pipeline/artifact/manifest.h"

namespace hbr::inline artifact {

// Where things are.
struct Workspace {
  std::filesystem::path out;         // artifacts, and .plan/ with the slices
  std::filesystem::path programs;    // the stage programs
  std::filesystem::path repository;  // sources that are not absolute are below it
  bool remember = false;             // may write down the signs of files hashed again (only under the lock)
};

// Hashes of programs and sources, remembered in OUT/.plan/hashes.json by the files' signs.
class HashCache {
 public:
  explicit HashCache(const Workspace& workspace);
  std::string program(const std::string& name);  // throws InputError where it is missing
  std::string source(const std::string& path);   // empty where it is missing
  void save();                                   // where anything was hashed and the workspace may remember

 private:
  template <class Hash>
  std::string remembered(const std::filesystem::path& path, Hash hash);

  const Workspace& workspace_;
  std::map<std::string, std::pair<std::string, std::string>> known_;  // path -> fingerprint, sha256
  bool changed_ = false;
};

enum class State {
  fresh,    // as its ingredients say
  stale,    // made from other ingredients
  missing,  // no artifact
  damaged,  // the artifact or its manifest is not what the stage left
  waiting   // an input is not fresh: only its rebuilding tells
};

// Whether an artifact is what its manifest says, whatever it should be made from.
struct Found {
  State state = State::missing;        // missing, damaged or fresh
  std::string why;                     // one line; empty where it is fresh
  std::optional<Manifest> manifest;    // where it can be read
  std::optional<std::uint64_t> bytes;  // of the artifact, where it was read
};

enum class Compare {
  by_fingerprint,  // the artifact is read where its fingerprint is another than when it was hashed
  by_content       // it is read
};

// What `audit` refuses, `make` makes again and `status` calls damaged: all of them ask here. Where the
// content is another though the fingerprint is the same, the manifest forgets the fingerprint, so that the
// next look finds it, too.
Found look_at(const Workspace& workspace, const Node& node, Compare how);

struct Freshness {
  State state = State::missing;
  std::string why;  // "settings.generations 100 -> 200", "program layer1 changed", ...; empty when fresh
  Ingredients ingredients;  // incomplete when waiting
  std::string key;          // empty when waiting
  std::string sha256;       // of a fresh artifact
};

// `inputs`: the hashes of the node's inputs by their name there.
Freshness freshness_of(const Workspace& workspace, const Node& node,
                       std::map<std::string, std::string> inputs, HashCache& hashes);

// One entry for every node.
std::vector<Freshness> freshness_of(const Workspace& workspace, const Graph& graph);

// The hash of an artifact as it is now: the manifest's while the artifact's fingerprint is the same, else
// hashed again. Empty where it is missing or not what its manifest says.
std::string artifact_hash(const Workspace& workspace, const Node& node);

// Throws InputError where an output is given twice or outside OUT, or an input is not made by an earlier
// node.
void check_graph(const Graph& graph);

}  // namespace hbr::inline artifact
