#include "pipeline/artifact/tool.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <set>
#include <sstream>
#include <thread>

#include "pipeline/artifact/child.h"
#include "pipeline/artifact/lock.h"
#include "pipeline/artifact/program.h"
#include "pipeline/artifact/runner.h"
#include "pipeline/artifact/selection.h"
#include "pipeline/artifact/settings.h"
#include "pipeline/artifact/status.h"
#include "pipeline/artifact/version.h"
#include "pipeline/core/file_error.h"

namespace hbr {
namespace fs = std::filesystem;
namespace {

struct Arguments {
  fs::path profile;
  std::vector<std::string> goals{"all"};
  int replication = -1;
  int threads = 0;  // 0: the processors, shared among make's jobs
  std::string make = "make";
  int parent = 0;      // the make that called; 0 for a person
  std::string output;  // of `run`
  Workspace workspace;
  RunOptions run;
};

// The N of make's -jN; 1 without, 0 for a -j without a number.
int jobs_of_make() {
  const char* flags = std::getenv("MAKEFLAGS");
  if (!flags) return 1;
  std::istringstream words(flags);
  for (std::string word; words >> word && word != "--";)
    if (word.starts_with("-j")) return word.size() == 2 ? 0 : std::atoi(word.c_str() + 2);
  return 1;
}

int threads_of_stage(int asked) {
  if (asked > 0) return asked;
  const int processors = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  const int jobs = jobs_of_make();
  return jobs == 0 ? 1 : std::max(1, processors / jobs);
}

fs::path absolute_path(const fs::path& path) { return fs::absolute(path).lexically_normal(); }

// What make is to run: a phony target for each node that is not fresh. The order of making is all that make
// decides; the recipe finds the rest in its environment.
std::string plan_for_make(const Graph& graph, const std::vector<Freshness>& freshness) {
  std::set<std::string> listed;
  std::string rules, all;
  for (std::size_t i = 0; i < graph.size(); ++i) {
    if (freshness[i].state == State::fresh) continue;
    const Node& node = graph[i];
    std::string before;
    for (const auto& [name, output] : node.inputs)
      if (listed.contains(output)) before += " " + output;
    listed.insert(node.output);
    all += " \\\n  " + node.output;
    rules += fmt::format("\n{}:{}\n\t@exec \"$$HBR_TOOL\" run {}\n", node.output, before, node.output);
  }
  return fmt::format(
      "# Written by hbr make: what is not as the profile says, and in which order to make it.\n"
      "all:{}\n.PHONY: all{}\n{}",
      all, all, rules);
}

std::size_t count_stale(const std::vector<Freshness>& freshness) {
  return static_cast<std::size_t>(std::count_if(freshness.begin(), freshness.end(),
                                                [](const Freshness& f) { return f.state != State::fresh; }));
}

void nothing_to_do(const Arguments& arguments, const Graph& graph) {
  fmt::print("{}: nothing to do, {} artifacts are as they should be\n", arguments.workspace.out.string(),
             graph.size());
}

void set(const char* name, const std::string& value) { ::setenv(name, value.c_str(), 1); }

// Where the folder is there and can only be read: why.
int unwritable(const fs::path& out) {
  for (const fs::path& folder : {out, out / ".plan"})
    if (fs::is_directory(folder) && ::access(folder.c_str(), W_OK) != 0) return errno;
  return 0;
}

// A finished run may be kept where nobody, or only its owner, can write.
int look_only(const Arguments& arguments, const Graph& graph, int reason) {
  const std::size_t stale = count_stale(freshness_of(arguments.workspace, graph));
  if (stale > 0)
    throw file_error(
        arguments.workspace.out,
        fmt::format("{} of {} artifacts are to be made (`make status` says why), and this output folder "
                    "can't be written",
                    stale, graph.size())
            .c_str(),
        reason);
  nothing_to_do(arguments, graph);
  return 0;
}

// Becomes make, which runs what is not fresh. The lock stays with it.
int make(Arguments& arguments, const Graph& graph, const Graph& all) {
  if (arguments.parent > 0) end_with_parent(arguments.parent);
  if (const int reason = unwritable(arguments.workspace.out)) return look_only(arguments, graph, reason);
  lock_folder(arguments.workspace.out);
  arguments.workspace.remember = true;
  remove_temporaries(arguments.workspace, all);
  const std::vector<Freshness> freshness = freshness_of(arguments.workspace, graph);
  const std::size_t stale = count_stale(freshness);
  if (stale == 0) {
    nothing_to_do(arguments, graph);
    return 0;
  }
  for (std::size_t i = 0; i < graph.size(); ++i)
    if (freshness[i].state != State::fresh) write_slice(arguments.workspace.out, graph[i]);
  const fs::path plan = arguments.workspace.out / ".plan/plan.mk";
  write_whole(plan, plan_for_make(graph, freshness));
  const int threads = threads_of_stage(arguments.threads);
  fmt::print("{}: {} of {} artifacts to make, {} to a stage program\n", arguments.workspace.out.string(),
             stale, graph.size(),
             threads == 1 ? std::string("one thread") : fmt::format("{} threads", threads));
  std::fflush(stdout);

  set("HBR_TOOL", fs::read_symlink("/proc/self/exe").string());
  set("HBR_OUT", arguments.workspace.out.string());
  set("HBR_PROGRAMS", arguments.workspace.programs.string());
  set("HBR_REPOSITORY", arguments.workspace.repository.string());
  set("HBR_THREADS", std::to_string(threads_of_stage(arguments.threads)));
  set("HBR_LAUNCH", arguments.run.launch);
  set("HBR_VERSION", version_of(arguments.workspace.repository));
  set("HBR_MAKE", std::to_string(::getpid()));  // exec keeps the number
  if (jobs_of_make() != 1) set("HBR_PROGRESS", "lines");
  ::execlp(arguments.make.c_str(), arguments.make.c_str(), "--no-print-directory", "-f", plan.c_str(), "all",
           nullptr);
  throw InputError("can't run {}: {}", arguments.make, std::strerror(errno));
}

// What make would run, by the programs as they are. Writes nothing.
int plan(Arguments& arguments, const Graph& graph) {
  const std::vector<Freshness> freshness = freshness_of(arguments.workspace, graph);
  if (count_stale(freshness) == 0) nothing_to_do(arguments, graph);
  arguments.run.threads = threads_of_stage(arguments.threads);
  for (std::size_t i = 0; i < graph.size(); ++i) {
    if (freshness[i].state == State::fresh) continue;
    const fs::path artifact = arguments.workspace.out / graph[i].output;
    const auto command = stage_command(arguments.workspace, graph[i], arguments.run,
                                       {artifact, artifact.string() + ".checkpoint"});
    fmt::print("{}{}\n", fmt::join(command, " "),
               freshness[i].state == State::waiting ? "  # if its inputs become others" : "");
  }
  return 0;
}

// What stages read besides artifacts and is not there.
int missing(const Arguments& arguments, const Graph& graph) {
  std::set<fs::path> files;
  for (const Node& node : graph)
    for (const std::string& source : node.sources)
      if (const fs::path path = arguments.workspace.repository / source; !fs::exists(path))
        files.insert(path);
  for (const fs::path& file : files) fmt::print("{}\n", file.string());
  return 0;
}

int run(Arguments& arguments) {
  if (const char* make_process = std::getenv("HBR_MAKE")) {
    end_with_parent(std::atoi(make_process));
    leave_lock_to_parent();
  }
  arguments.workspace.remember = true;
  arguments.run.threads = threads_of_stage(arguments.threads);
  Node named;
  named.output = arguments.output;
  return run_node(arguments.workspace, read_slice(slice_path(arguments.workspace.out, named)), arguments.run);
}

int tell_audit(const Arguments& arguments, const Graph& graph) {
  const Audit found = audit(arguments.workspace, graph);
  for (const std::string& problem : found.problems) fmt::print(stderr, "{}\n", problem);
  fmt::print("{}\n", found.summary);
  return found.problems.empty() ? 0 : 1;
}

}  // namespace

int tool_main(int argc, char** argv, const std::function<Graph(const fs::path&)>& experiment) {
  Arguments a;
  a.workspace.programs = fs::read_symlink("/proc/self/exe").parent_path();
  a.workspace.repository = fs::current_path();
  CLI::App app("Makes the artifacts of an experiment, each from its slice of the profile");
  app.require_subcommand(1);
  const auto add = [&](const char* name, const char* meaning) {
    CLI::App* command = app.add_subcommand(name, meaning);
    command->add_option("--out", a.workspace.out, "output folder")->required()->envname("HBR_OUT");
    command->add_option("--programs", a.workspace.programs, "folder of the stage programs")
        ->envname("HBR_PROGRAMS");
    command->add_option("--repository", a.workspace.repository, "what sources are below")
        ->envname("HBR_REPOSITORY");
    command->add_option("--threads", a.threads, "threads of one stage program")
        ->check(CLI::Range(0, 4096))
        ->envname("HBR_THREADS");
    command->add_option("--launch", a.run.launch, "words before every stage program")->envname("HBR_LAUNCH");
    return command;
  };
  const auto add_for_profile = [&](const char* name, const char* meaning) {
    CLI::App* command = add(name, meaning);
    command->add_option("--profile", a.profile, "profile (TOML)")->required();
    command->add_option("--replication", a.replication, "only this one of the goals' stages")
        ->check(CLI::Range(0, 9999));
    command->add_option("goals", a.goals, "stages, families of stages, or all");
    return command;
  };
  CLI::App* const make_command = add_for_profile("make", "make what is not fresh (through make)");
  make_command->add_option("--make", a.make, "the make to use");
  make_command->add_option("--parent", a.parent, "the process with which to end");
  CLI::App* const plan_command = add_for_profile("plan", "check the profile and list what make would run");
  CLI::App* const missing_command = add_for_profile("missing", "list the files that stages read and lack");
  CLI::App* const status_command = add_for_profile("status", "tell what is fresh, stale or missing, and why");
  CLI::App* const audit_command =
      add_for_profile("audit", "read every artifact again and compare it with its manifest");
  CLI::App* const graph_command = add_for_profile("graph", "the stage graph as Graphviz text");
  CLI::App* const run_command = add("run", "make one artifact (called by make)");
  run_command->add_option("output", a.output, "the artifact, below the output folder")->required();
  run_command->add_option("--version", a.run.version, "of the repository, for the manifest")
      ->envname("HBR_VERSION");
  return guarded_main("hbr", [&] {
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& asked) {  // --help
      return app.exit(asked);
    } catch (const CLI::Error& error) {
      throw InputError("{}", error.what());
    }
    for (fs::path* path : {&a.workspace.programs, &a.workspace.repository}) *path = absolute_path(*path);
    if (run_command->parsed()) return run(a);
    const Graph all = experiment(a.profile);
    check_graph(all);
    const Graph graph = selected(all, a.goals, a.replication);
    if (graph_command->parsed()) {
      fmt::print("{}", graph_as_dot(graph));
      return 0;
    }
    if (status_command->parsed()) {
      fmt::print("{}", status_table(graph, freshness_of(a.workspace, graph)));
      return 0;
    }
    if (audit_command->parsed()) return tell_audit(a, graph);
    if (plan_command->parsed()) return plan(a, graph);
    if (missing_command->parsed()) return missing(a, graph);
    HBR_CHECK(make_command->parsed(), "no command");
    return make(a, graph, all);
  });
}

}  // namespace hbr
