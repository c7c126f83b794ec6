#include "pipeline/artifact/runner.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <set>

#include "pipeline/artifact/claim.h"
#include "pipeline/artifact/launch.h"
#include "pipeline/artifact/progress.h"
#include "pipeline/artifact/tally.h"
#include "pipeline/artifact/temporary.h"
#include "pipeline/core/check.h"
#include "pipeline/process/run_child.h"

namespace hbr::inline artifact {
namespace fs = std::filesystem;
namespace {

const std::string kCheckpoint = ".checkpoint-";

// A checkpoint belongs to one key: another's would lead to other bytes.
fs::path checkpoint_path(const fs::path& artifact, const std::string& key) {
  return artifact.parent_path() /
         fmt::format("{}{}-{}", kCheckpoint, key.substr(0, 16), artifact.filename().string());
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
  const Temporary old(temporary_beside(artifact, "old"));
  const fs::file_status before = fs::symlink_status(artifact);  // of a link itself, wherever it leads
  if (fs::exists(before) && (fs::is_directory(before) || fs::is_directory(output)))
    fs::rename(artifact, old.path);
  fs::rename(output, artifact);
}

nlohmann::json run_facts(const RunRecord& record, double waited, const std::vector<std::string>& failures,
                         const RunOptions& options) {
  nlohmann::json facts = record.toolchain;
  facts.update({{"started", record.started},
                {"waited_seconds", waited},
                {"seconds", record.seconds},
                {"cpu_seconds", record.cpu_seconds},
                {"peak_memory_bytes", record.peak_memory_bytes},
                {"exit", record.exit_code},
                {"host", record.host},
                {"threads", record.threads},
                {"launch", options.handover ? options.handover->launch : options.launch},
                {"tries", failures.size() + 1},
                {"failures", failures},
                {"version", options.version}});
  return facts;
}

std::map<std::string, std::string> inputs_of(const Workspace& workspace, const Node& node) {
  std::map<std::string, std::string> inputs;
  for (const auto& [input, output] : node.inputs) {
    Node made_before;
    made_before.output = output;
    inputs[input] = artifact_hash(workspace, made_before);
    if (inputs[input].empty())
      throw InputError(
          "{}: its input {} is missing or damaged: give the same make again, which makes it first",
          name_of(node), (workspace.out / output).string());
  }
  return inputs;
}

// What a stage reads may be changed while it waits for its turn or runs; then nobody knows what it has read.
void check_unchanged(const Workspace& workspace, const Node& node, const Ingredients& made_from) {
  HashCache hashes(workspace);
  for (std::size_t i = 0; i < node.sources.size(); ++i)
    if (hashes.source(node.sources[i]) != made_from.sources[i])
      throw InputError("{}: the file {} was changed while this ran: give the same command again",
                       name_of(node), (workspace.repository / node.sources[i]).string());
  const std::map<std::string, std::string> inputs = inputs_of(workspace, node);
  for (const auto& [name, output] : node.inputs)
    if (inputs.at(name) != made_from.inputs.at(name))
      throw InputError("{}: {} was changed while this ran: give the same command again", name_of(node),
                       (workspace.out / output).string());
}

// Where the network failed, the launcher of this runner may be gone and this still be here.
void check_wanted(const Workspace& workspace, const Node& node, const RunOptions& options) {
  if (options.handover && options.handover->claim != claim_of(workspace.out))
    throw InputError("{}: the make that wanted this has ended", name_of(node));
}

// Puts what the stage left in the artifact's place, and its manifest beside it.
void keep(const Workspace& workspace, const Node& node, const Freshness& found, const fs::path& output,
          nlohmann::json run) {
  const fs::path artifact = workspace.out / node.output, manifest_file = manifest_path(workspace.out, node);
  Manifest manifest{found.ingredients, {}, found.key, content_of(output), "", std::move(run)};
  const std::optional<Manifest> before = look_at(workspace, node, Compare::by_fingerprint).manifest;
  if (before && before->key == manifest.key && before->content.sha256 != manifest.content.sha256)
    fmt::print(stderr, "{}: not reproducible: the same ingredients gave other bytes than before\n",
               name_of(node));
  sync_to_disk(output);
  replace(artifact, output);
  manifest.fingerprint = fingerprint(artifact);
  try {
    if (fs::is_directory(fs::symlink_status(manifest_file))) fs::remove_all(manifest_file);
    write_manifest(manifest_file, manifest);
  } catch (const InputError&) {
    fs::remove_all(artifact);  // nothing is known of an artifact without its manifest
    throw;
  }
}

}  // namespace

std::vector<std::string> stage_command(const Workspace& workspace, const Node& node,
                                       const RunOptions& options, const StagePlaces& places) {
  std::vector<std::string> command{(workspace.programs / node.program).string(),
                                   "--root",
                                   workspace.out.string(),
                                   "--slice",
                                   slice_path(workspace.out, node).string(),
                                   "--output",
                                   places.output.string(),
                                   "--checkpoint",
                                   places.checkpoint.string(),
                                   "--threads",
                                   std::to_string(options.threads)};
  if (!places.record.empty())
    command.insert(command.end(), {"--record", places.record.string(), "--program", places.program});
  return launched(options.launch, command);
}

int run_node(const Workspace& workspace, const Node& node, const RunOptions& options) {
  check_wanted(workspace, node, options);
  const std::string name = name_of(node);
  HashCache hashes(workspace);
  const Freshness found = freshness_of(workspace, node, inputs_of(workspace, node), hashes);
  if (found.state == State::fresh) return 0;
  const std::vector<std::string>& sources = found.ingredients.sources;
  if (std::find(sources.begin(), sources.end(), "") != sources.end())
    throw InputError("{}: {}", name, found.why);
  const fs::path artifact = workspace.out / node.output;
  if (found.state == State::damaged)
    fmt::print(stderr, "{}: {}; it is made again\n", artifact.string(), found.why);

  fs::create_directories(artifact.parent_path());
  const fs::path checkpoint = checkpoint_path(artifact, found.key);
  remove_other_checkpoints(artifact, checkpoint);
  const std::optional<Cost> cost = MeasuredCosts(workspace.out).of(node, options.threads);
  Tries tries(name, options.retries,
              options.handover ? options.handover->failures : std::vector<std::string>{});
  for (;;) {
    // Names of their own for every try: what was lost on the way may still be writing somewhere.
    const std::string mark = tries.failed() == 0 ? "" : fmt::format("{}", tries.failed());
    const Temporary output(temporary_beside(artifact, mark)),
        record_file(temporary_beside(artifact, "record" + mark));
    tell_launcher(name, std::max(1, options.threads), request_for(cost, tries.failed()));
    const ChildResult child = run_child(stage_command(
        workspace, node, options, {output.path, checkpoint, record_file.path, found.ingredients.program}));
    const std::optional<RunRecord> record = read_record(record_file.path);
    if (is_refusal(child, record, options.launch)) return 2;
    std::string why = failure_of(child, record, options.launch, node.program);
    if (why.empty() && !fs::exists(output.path))
      why = fmt::format("{} succeeded, but left nothing at {}", node.program, output.path.string());
    if (!why.empty()) {
      tries.fail(why, child.stopped);
      continue;
    }
    check_unchanged(workspace, node, found.ingredients);
    check_wanted(workspace, node, options);
    const double waited = options.waited_seconds + std::max(0.0, child.seconds - record->seconds);
    keep(workspace, node, found, output.path, run_facts(*record, waited, tries.failures(), options));
    fs::remove_all(checkpoint);
    const bool tell = waited >= 1 && (!options.launch.empty() || options.handover);
    const std::string tally =
        options.counted ? count_made(workspace.out, node.stage, record->seconds, seconds_now()) : "";
    fmt::print(stderr, "{}: made in {}{}{}\n", name, duration_text(record->seconds),
               tell ? fmt::format(", {} after it was launched", duration_text(waited)) : "",
               tally.empty() ? "" : fmt::format("; {}", tally));
    return 0;
  }
}

void remove_temporaries(const Workspace& workspace, const Graph& graph) {
  std::set<fs::path> folders{workspace.out / ".plan"};
  for (const Node& node : graph) {
    folders.insert((workspace.out / node.output).parent_path());
    folders.insert(slice_path(workspace.out, node).parent_path());
  }
  for (const fs::path& folder : folders)
    if (fs::is_directory(folder)) remove_abandoned(folder);
}

}  // namespace hbr::inline artifact
