#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>

#include "pipeline/artifact/lock.h"
#include "pipeline/artifact/plan.h"
#include "pipeline/artifact/progress.h"
#include "pipeline/artifact/tally.h"
#include "pipeline/artifact/threads.h"
#include "pipeline/artifact/tool_commands.h"
#include "pipeline/artifact/version.h"
#include "pipeline/core/file_error.h"
#include "pipeline/process/child.h"

namespace hbr::inline artifact {
namespace fs = std::filesystem;

std::size_t count_stale(const std::vector<Freshness>& freshness) {
  return static_cast<std::size_t>(std::count_if(freshness.begin(), freshness.end(),
                                                [](const Freshness& f) { return f.state != State::fresh; }));
}

void say_nothing_to_do(const ToolArguments& arguments, const Graph& graph) {
  fmt::print("{}: nothing to do, {} artifacts are as they should be\n", arguments.workspace.out.string(),
             graph.size());
}

int threads_to_launch_with(const ToolArguments& arguments) {
  return arguments.run.launch.empty() ? threads_of_stage(arguments.threads) : arguments.threads;
}

namespace {

void set(const char* name, const std::string& value) { ::setenv(name, value.c_str(), 1); }

// Where the folder is there and can only be read: why.
int unwritable(const fs::path& out) {
  for (const fs::path& folder : {out, out / ".plan"})
    if (fs::is_directory(folder) && ::access(folder.c_str(), W_OK) != 0) return errno;
  return 0;
}

// A finished run may be kept where nobody, or only its owner, can write.
int look_only(const ToolArguments& arguments, const Graph& graph, int reason) {
  const std::size_t stale = count_stale(freshness_of(arguments.workspace, graph));
  if (stale > 0)
    throw file_error(
        arguments.workspace.out,
        fmt::format("{} of {} artifacts are to be made (`make status` says why), and this output folder "
                    "can't be written",
                    stale, graph.size())
            .c_str(),
        reason);
  say_nothing_to_do(arguments, graph);
  return 0;
}

}  // namespace

int make_artifacts(ToolArguments& arguments, const Graph& graph, const Graph& all) {
  if (arguments.parent > 0) end_with_parent(arguments.parent);
  if (const int reason = unwritable(arguments.workspace.out)) return look_only(arguments, graph, reason);
  lock_folder(arguments.workspace.out);
  arguments.workspace.remember = true;
  remove_temporaries(arguments.workspace, all);
  const std::vector<Freshness> freshness = freshness_of(arguments.workspace, graph);
  const std::size_t stale = count_stale(freshness);
  if (stale == 0) {
    say_nothing_to_do(arguments, graph);
    return 0;
  }
  std::vector<std::string> to_run;
  for (std::size_t i = 0; i < graph.size(); ++i)
    if (freshness[i].state != State::fresh) to_run.push_back(graph[i].stage);
  start_tally(arguments.workspace.out, to_run, seconds_now());
  const int threads = threads_to_launch_with(arguments);
  const std::size_t launches =
      write_plan(arguments.workspace.out, graph, freshness, threads, arguments.group);
  fmt::print(
      "{}: {} of {} artifacts to make{}, {} to a stage program; stopped at any time, the same command goes "
      "on\n",
      arguments.workspace.out.string(), stale, graph.size(),
      launches == stale ? "" : fmt::format(" in {} launches", launches),
      threads == 0   ? std::string("the processors that it is launched on")
      : threads == 1 ? std::string("one thread")
                     : fmt::format("{} threads", threads));
  std::fflush(stdout);

  set("HBR_TOOL", fs::read_symlink("/proc/self/exe").string());
  set("HBR_OUT", arguments.workspace.out.string());
  set("HBR_PROGRAMS", arguments.workspace.programs.string());
  set("HBR_REPOSITORY", arguments.workspace.repository.string());
  set("HBR_THREADS", std::to_string(threads));
  set("HBR_PLACE", this_place());
  set("HBR_LAUNCH", arguments.run.launch);
  set("HBR_RETRY", std::to_string(arguments.run.retries));
  set("HBR_VERSION", version_of(arguments.workspace.repository));
  set("HBR_MAKE", std::to_string(::getpid()));  // exec keeps the number
  if (jobs_of_make() != 1) set("HBR_PROGRESS", "lines");
  become({arguments.make, "--no-print-directory", "-f", plan_path(arguments.workspace.out).string(), "all"});
}

}  // namespace hbr::inline artifact
