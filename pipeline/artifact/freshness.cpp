#include "pipeline/artifact/freshness.h"

#include <algorithm>
#include <set>

#include "pipeline/artifact/json_file.h"
#include "pipeline/core/file_error.h"
#include "pipeline/core/settings.h"

namespace hbr::inline artifact {
namespace fs = std::filesystem;
namespace {

// "settings.generations 100 -> 200; ..." for the first few that differ.
std::string differences(const nlohmann::json& before, const nlohmann::json& after) {
  const nlohmann::json was = before.flatten(), is = after.flatten();
  std::vector<std::string> found;
  const auto shown = [](const nlohmann::json& all, const std::string& key) {
    return all.contains(key) ? all.at(key).dump() : std::string("none");
  };
  std::set<std::string> keys;
  for (const auto& [key, value] : was.items()) keys.insert(key);
  for (const auto& [key, value] : is.items()) keys.insert(key);
  for (const std::string& key : keys) {
    if (was.contains(key) && is.contains(key) && was.at(key) == is.at(key)) continue;
    std::string name = key.empty() ? key : key.substr(1);
    std::replace(name.begin(), name.end(), '/', '.');
    found.push_back(fmt::format("{} {} -> {}", name, shown(was, key), shown(is, key)));
  }
  const std::size_t all = found.size();
  constexpr std::size_t kShown = 3;
  if (all > kShown) found.resize(kShown);
  return fmt::format("{}{}", fmt::join(found, ", "),
                     all > kShown ? fmt::format(" and {} more", all - kShown) : "");
}

std::string why_stale(const Node& node, const Ingredients& was, const Ingredients& is) {
  std::vector<std::string> reasons;
  if (was.slice != is.slice) reasons.push_back(differences(was.slice, is.slice));
  if (was.program != is.program) reasons.push_back(fmt::format("program {} changed", node.program));
  for (const auto& [name, output] : node.inputs) {
    const auto before = was.inputs.find(name);
    if (before != was.inputs.end() && before->second != is.inputs.at(name))
      reasons.push_back(fmt::format("input {} changed", output));
  }
  for (std::size_t i = 0; i < node.sources.size(); ++i)
    if (i >= was.sources.size() || was.sources[i] != is.sources[i])
      reasons.push_back(fmt::format("file {} changed", node.sources[i]));
  return reasons.empty() ? "files changed" : fmt::format("{}", fmt::join(reasons, ", "));
}

// Whoever tells what is wrong with a file names it himself.
std::string without(const fs::path& file, const std::string& complaint) {
  const std::string lead = file.string() + ": ";
  return complaint.starts_with(lead) ? complaint.substr(lead.size()) : complaint;
}

// All but the comparison of the artifact with its manifest.
Found manifest_of(const Workspace& workspace, const Node& node) {
  Found found;
  const fs::path artifact = workspace.out / node.output, file = manifest_path(workspace.out, node);
  std::error_code error;
  try {
    if (fs::exists(file, error) || error)
      found.manifest = read_manifest(file);
    else
      found.why = "its manifest is missing";
  } catch (const InputError& problem) {
    found.why = fmt::format("its manifest is damaged: {}", problem.what());
  }
  if (!fs::exists(artifact, error)) {
    found.why =
        error ? "damaged: " + without(artifact, file_error(artifact, "can't read", error.value()).what())
              : "missing";
    found.state = error ? State::damaged : State::missing;
  } else {
    found.state = found.manifest ? State::fresh : State::damaged;
  }
  return found;
}

// A fingerprint that is still the same would hide from the next look what this one has found.
void forget_fingerprint(const fs::path& file, const std::string& print) {
  try {
    Manifest manifest = read_manifest(file);
    if (manifest.fingerprint != print) return;  // a make has been here meanwhile
    manifest.fingerprint.clear();
    write_manifest(file, manifest);
  } catch (const InputError&) {  // a folder that can only be read: no make can mend it either
  }
}

// Compares the artifact with its manifest.
void compare(const Workspace& workspace, const Node& node, Compare how, Found& found) {
  const fs::path artifact = workspace.out / node.output, file = manifest_path(workspace.out, node);
  Manifest& manifest = *found.manifest;
  std::string print, sha256;
  try {
    print = fingerprint(artifact);
    if (how == Compare::by_fingerprint && !print.empty() && print == manifest.fingerprint) return;
    const Content content = content_of(artifact);
    sha256 = content.sha256;
    found.bytes = content.bytes;
  } catch (const InputError& problem) {
    found.state = State::damaged;
    found.why = "damaged: " + without(artifact, problem.what());
    return;
  }
  if (sha256 != manifest.content.sha256) {
    found.state = State::damaged;
    found.why = fmt::format("damaged: expected sha256 {}, found {}", manifest.content.sha256, sha256);
    if (print == manifest.fingerprint) forget_fingerprint(file, print);
  } else if (print != manifest.fingerprint && workspace.remember) {
    manifest.fingerprint = print;
    write_manifest(file, manifest);
  }
}

}  // namespace

// The file as it is written.
struct KnownHash {
  std::string file, print, sha256;
};
template <class Fields>
void describe(Fields& f, KnownHash& h) {
  f.text("file", h.file, "path");
  f.text("sign", h.print, "when it was hashed");
  f.text("sha256", h.sha256, "of its content");
}
struct KnownHashes {
  std::vector<KnownHash> hashes;
};
template <class Fields>
void describe(Fields& f, KnownHashes& h) {
  f.tables("hashes", h.hashes, "programs and sources");
}

HashCache::HashCache(const Workspace& workspace) : workspace_(workspace) {
  const fs::path file = workspace.out / ".plan/hashes.json";
  try {
    for (const auto& known :
         settings_from_json<KnownHashes>(unsealed(read_json(file), file.string()), file.string()).hashes)
      known_[known.file] = {known.print, known.sha256};
  } catch (const InputError&) {
    known_.clear();  // only a cache: what is not there, or was edited, is hashed again
  }
}

template <class Hash>
std::string HashCache::remembered(const fs::path& path, Hash hash) {
  const std::string print = fingerprint(path);
  auto& [known_print, known_hash] = known_[path.string()];
  if (print.empty() || print != known_print) {
    known_hash = hash(path);
    known_print = print;
    changed_ = true;
  }
  return known_hash;
}

std::string HashCache::program(const std::string& name) {
  const fs::path path = workspace_.programs / name;
  if (!fs::is_regular_file(path))
    throw InputError("{}: this stage program is missing: `make build` builds it", path.string());
  return remembered(path, sha256_of_program);
}

std::string HashCache::source(const std::string& path) {
  const fs::path full = workspace_.repository / path;
  if (!fs::exists(full)) return "";
  return remembered(full, [](const fs::path& file) { return content_of(file).sha256; });
}

void HashCache::save() {
  if (changed_ && workspace_.remember) {
    KnownHashes all;
    for (const auto& [file, known] : known_) all.hashes.push_back({file, known.first, known.second});
    write_whole(workspace_.out / ".plan/hashes.json", sealed(settings_to_json(all)).dump(1));
  }
  changed_ = false;
}

Found look_at(const Workspace& workspace, const Node& node, Compare how) {
  Found found = manifest_of(workspace, node);
  if (found.state == State::fresh) compare(workspace, node, how, found);
  return found;
}

std::string artifact_hash(const Workspace& workspace, const Node& node) {
  const Found found = look_at(workspace, node, Compare::by_fingerprint);
  return found.state == State::fresh ? found.manifest->content.sha256 : "";
}

Freshness freshness_of(const Workspace& workspace, const Node& node,
                       std::map<std::string, std::string> inputs, HashCache& hashes) {
  Freshness found;
  found.ingredients.slice = slice_of(node);
  found.ingredients.program = hashes.program(node.program);
  found.ingredients.inputs = std::move(inputs);
  for (const std::string& source : node.sources) found.ingredients.sources.push_back(hashes.source(source));
  found.key = found.ingredients.key();
  for (std::size_t i = 0; i < node.sources.size(); ++i)
    if (found.ingredients.sources[i].empty()) {
      found.why = fmt::format("the file {}, which it reads, is missing",
                              (workspace.repository / node.sources[i]).string());
      return found;
    }

  Found artifact = manifest_of(workspace, node);
  if (artifact.state == State::fresh && artifact.manifest->key != found.key) {
    found.state = State::stale;
    found.why = why_stale(node, artifact.manifest->made_from, found.ingredients);
    return found;
  }
  if (artifact.state == State::fresh) compare(workspace, node, Compare::by_fingerprint, artifact);
  found.state = artifact.state;
  found.why = artifact.why;
  if (found.state == State::fresh) found.sha256 = artifact.manifest->content.sha256;
  return found;
}

std::vector<Freshness> freshness_of(const Workspace& workspace, const Graph& graph) {
  HashCache hashes(workspace);
  std::vector<Freshness> all;
  std::map<std::string, std::size_t> made;  // output -> node
  for (const Node& node : graph) {
    std::map<std::string, std::string> inputs;
    const std::string* waits_for = nullptr;
    for (const auto& [name, output] : node.inputs) {
      const Freshness& input = all[made.at(output)];
      if (input.state != State::fresh && !waits_for) waits_for = &output;
      inputs[name] = input.sha256;
    }
    made[node.output] = all.size();
    if (!waits_for) {
      all.push_back(freshness_of(workspace, node, std::move(inputs), hashes));
      continue;
    }
    Freshness waiting;
    std::error_code ignored;
    const bool exists = fs::exists(fs::symlink_status(workspace.out / node.output, ignored));
    waiting.state = exists ? State::waiting : State::missing;
    waiting.why = exists ? fmt::format("its input {} is to be made first", *waits_for) : "missing";
    all.push_back(waiting);
  }
  hashes.save();
  return all;
}

void check_graph(const Graph& graph) {
  std::set<std::string> taken, outputs;
  const auto inside_another = [&](const Node& node) {
    for (fs::path above = fs::path(node.output).parent_path(); !above.empty(); above = above.parent_path())
      if (outputs.contains(above.string()))
        throw InputError(
            "stage graph: {} (of stage {}) lies in {}, which is a folder that another stage makes",
            node.output, node.stage, above.string());
    const auto below = outputs.lower_bound(node.output + "/");
    if (below != outputs.end() && below->starts_with(node.output + "/"))
      throw InputError("stage graph: {} (of stage {}) is the folder of {}, which another stage makes",
                       node.output, node.stage, *below);
  };
  for (const Node& node : graph) {
    const fs::path path(node.output);
    // Plain names only: they become targets in a makefile.
    bool hidden =
        node.output.empty() || path.is_absolute() || path != path.lexically_normal() ||
        node.output.find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./") !=
            std::string::npos;
    for (const fs::path& part : path) hidden = hidden || part.string().starts_with(".");
    if (hidden) throw InputError("stage graph: '{}' is no place below the output folder", node.output);
    for (const std::string& place : {node.output, manifest_path("", node).string()})
      if (!taken.insert(place).second)
        throw InputError("stage graph: two nodes want the place {} (one of them {})", place, node.stage);
    inside_another(node);
    std::set<std::string> named;
    for (const auto& [name, output] : node.inputs) {
      if (!named.insert(name).second)
        throw InputError("stage graph: {} has two inputs '{}'", node.output, name);
      if (!outputs.contains(output))
        throw InputError("stage graph: {} needs {} as its input '{}', which no earlier node makes{}",
                         node.output, output, name, did_you_mean(output, {outputs.begin(), outputs.end()}));
    }
    outputs.insert(node.output);
  }
}

}  // namespace hbr::inline artifact
