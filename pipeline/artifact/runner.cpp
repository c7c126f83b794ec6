#include "pipeline/artifact/runner.h"

#include <fmt/chrono.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <set>

#include "pipeline/artifact/child.h"
#include "pipeline/artifact/progress.h"
#include "pipeline/artifact/toolchain.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace fs = std::filesystem;
namespace {

const std::string kTemporary = ".tmp-", kCheckpoint = ".checkpoint-";

// Hidden names beside the artifact; the file's name stands last so that it keeps its ending.
fs::path beside(const fs::path& artifact, const std::string& prefix, const std::string& mark) {
  return artifact.parent_path() / fmt::format("{}{}-{}", prefix, mark, artifact.filename().string());
}

// A checkpoint belongs to one key: another's would lead to other bytes.
fs::path checkpoint_path(const fs::path& artifact, const std::string& key) {
  return beside(artifact, kCheckpoint, key.substr(0, 16));
}

void remove_other_checkpoints(const fs::path& artifact, const fs::path& kept) {
  for (const auto& entry : fs::directory_iterator(artifact.parent_path())) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kCheckpoint) && name.ends_with(fmt::format("-{}", artifact.filename().string())) &&
        entry.path() != kept)
      fs::remove_all(entry.path());
  }
}

// What stood there before must not be mixed with a new folder.
void replace(const fs::path& artifact, const fs::path& output) {
  const fs::path old = beside(artifact, kTemporary, fmt::format("{}-old", ::getpid()));
  if (fs::is_directory(artifact) || fs::is_directory(output))
    if (fs::exists(artifact)) fs::rename(artifact, old);
  fs::rename(output, artifact);
  fs::remove_all(old);
}

[[noreturn]] void fail(const Node& node, const ChildResult& child) {
  if (child.signal)
    throw InputError("{}: {} was ended by a signal: {}", name_of(node), node.program,
                     ::strsignal(child.signal));
  throw InputError("{}: {} failed with exit code {}", name_of(node), node.program, child.exit_code);
}

nlohmann::json run_facts(const ChildResult& child, const RunOptions& options, std::time_t started) {
  char host[256] = "";
  ::gethostname(host, sizeof host - 1);
  nlohmann::json facts = toolchain();
  facts.update({{"started", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(started))},
                {"seconds", child.seconds},
                {"cpu_seconds", child.cpu_seconds},
                {"peak_memory_bytes", child.peak_memory_bytes},
                {"exit", child.exit_code},
                {"host", host},
                {"threads", options.threads},
                {"launch", options.launch},
                {"version", options.version}});
  return facts;
}

}  // namespace

std::vector<std::string> stage_command(const Workspace& workspace, const Node& node,
                                       const RunOptions& options, const fs::path& output,
                                       const fs::path& checkpoint) {
  std::vector<std::string> command;
  if (!options.launch.empty())
    command = {"/bin/sh", "-c", fmt::format("exec {} \"$@\"", options.launch), "sh"};
  for (const std::string& word :
       {(workspace.programs / node.program).string(), std::string("--root"), workspace.out.string(),
        std::string("--slice"), slice_path(workspace.out, node).string(), std::string("--output"),
        output.string(), std::string("--checkpoint"), checkpoint.string(), std::string("--threads"),
        std::to_string(options.threads)})
    command.push_back(word);
  return command;
}

fs::path slice_path(const fs::path& out, const Node& node) {
  return out / ".plan/slices" / (name_of(node) + ".json");
}

void write_slice(const fs::path& out, const Node& node) {
  nlohmann::json all = slice_of(node);
  all["program"] = node.program;
  all["replication"] = node.replication;
  all["sources"] = node.sources;
  const fs::path path = slice_path(out, node);
  fs::create_directories(path.parent_path());
  write_whole(path, all.dump(1) + "\n");
}

Node read_slice(const fs::path& file) {
  std::ifstream stream(file);
  if (!stream) throw InputError("{}: can't read this slice", file.string());
  try {
    const nlohmann::json all = nlohmann::json::parse(stream);
    Node node;
    all.at("program").get_to(node.program);
    all.at("stage").get_to(node.stage);
    all.at("replication").get_to(node.replication);
    all.at("output").get_to(node.output);
    node.settings = all.at("settings");
    for (const auto& [name, output] : all.at("inputs").items()) node.inputs.emplace_back(name, output);
    all.at("sources").get_to(node.sources);
    node.variation = all.value("variation", "");
    return node;
  } catch (const nlohmann::json::exception& error) {
    throw InputError("{}: not a slice: {}", file.string(), error.what());
  }
}

int run_node(const Workspace& workspace, const Node& node, const RunOptions& options) {
  const std::string name = name_of(node);
  std::map<std::string, std::string> inputs;
  for (const auto& [input, output] : node.inputs) {
    Node made_before;
    made_before.output = output;
    inputs[input] = artifact_hash(workspace, made_before);
    if (inputs[input].empty())
      throw InputError("{}: its input {} is missing or damaged", name, (workspace.out / output).string());
  }
  HashCache hashes(workspace);
  const Freshness found = freshness_of(workspace, node, std::move(inputs), hashes);
  if (found.state == State::fresh) return 0;
  const std::vector<std::string>& sources = found.ingredients.sources;
  if (std::find(sources.begin(), sources.end(), "") != sources.end())
    throw InputError("{}: {}", name, found.why);
  const fs::path artifact = workspace.out / node.output, manifest_file = manifest_path(workspace.out, node);
  if (found.state == State::damaged)
    fmt::print(stderr, "{}: {}; it is made again\n", artifact.string(), found.why);

  fs::create_directories(artifact.parent_path());
  const fs::path output = beside(artifact, kTemporary, std::to_string(::getpid()));
  const fs::path checkpoint = checkpoint_path(artifact, found.key);
  remove_other_checkpoints(artifact, checkpoint);
  try {
    const std::time_t started = std::time(nullptr);
    const ChildResult child = run_child(stage_command(workspace, node, options, output, checkpoint));
    if (child.exit_code == 2) {
      fs::remove_all(output);
      return 2;  // an input error: the stage has said what was wrong
    }
    if (child.exit_code != 0) fail(node, child);
    if (!fs::exists(output))
      throw InputError("{}: {} succeeded, but left nothing at {}", name, node.program, output.string());

    Manifest manifest{found.ingredients, found.key, content_of(output), "",
                      run_facts(child, options, started)};
    const std::optional<Manifest> before = read_manifest(manifest_file);
    if (before && before->key == manifest.key && before->content.sha256 != manifest.content.sha256)
      fmt::print(stderr, "{}: not reproducible: the same ingredients gave other bytes than before\n", name);
    sync_to_disk(output);
    replace(artifact, output);
    manifest.sign = sign_of(artifact);
    try {
      write_manifest(manifest_file, manifest);
    } catch (const InputError&) {
      fs::remove_all(artifact);  // nothing is known of an artifact without its manifest
      throw;
    }
    fs::remove_all(checkpoint);
    fmt::print(stderr, "{}: made in {}\n", name, duration_text(child.seconds));
  } catch (...) {
    std::error_code ignored;
    fs::remove_all(output, ignored);
    throw;
  }
  return 0;
}

void remove_temporaries(const Workspace& workspace, const Graph& graph) {
  std::set<fs::path> folders{workspace.out / ".plan"};
  for (const Node& node : graph) folders.insert((workspace.out / node.output).parent_path());
  for (const fs::path& folder : folders) {
    if (!fs::is_directory(folder)) continue;
    for (const auto& entry : fs::directory_iterator(folder))
      if (entry.path().filename().string().starts_with(kTemporary)) fs::remove_all(entry.path());
  }
}

}  // namespace hbr
