#include "pipeline/artifact/tool.h"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdlib>
#include <set>

#include "pipeline/artifact/group.h"
#include "pipeline/artifact/json_file.h"
#include "pipeline/artifact/lock.h"
#include "pipeline/artifact/plan.h"
#include "pipeline/artifact/program.h"
#include "pipeline/artifact/progress.h"
#include "pipeline/artifact/record.h"
#include "pipeline/artifact/runner.h"
#include "pipeline/artifact/selection.h"
#include "pipeline/artifact/status.h"
#include "pipeline/artifact/tally.h"
#include "pipeline/artifact/threads.h"
#include "pipeline/artifact/version.h"
#include "pipeline/core/file_error.h"
#include "pipeline/core/settings.h"
#include "pipeline/process/child.h"

namespace hbr {
namespace fs = std::filesystem;
namespace {

struct Arguments {
  fs::path profile;
  std::vector<std::string> goals{"all"};
  int replication = -1;
  int threads = 0;  // 0: the processors, shared among make's jobs
  std::string make = "make";
  int parent = 0;                    // the make that called; 0 for a person
  double group = 0;                  // seconds of stages that are run by one launch
  std::vector<std::string> outputs;  // of `run`
  std::string handover;              // JSON
  fs::path record;
  Workspace workspace;
  RunOptions run;
};

fs::path absolute_path(const fs::path& path) { return fs::absolute(path).lexically_normal(); }

std::size_t count_stale(const std::vector<Freshness>& freshness) {
  return static_cast<std::size_t>(std::count_if(freshness.begin(), freshness.end(),
                                                [](const Freshness& f) { return f.state != State::fresh; }));
}

void nothing_to_do(const Arguments& arguments, const Graph& graph) {
  fmt::print("{}: nothing to do, {} artifacts are as they should be\n", arguments.workspace.out.string(),
             graph.size());
}

// 0 where each program is to count the processors that it finds where it is launched.
int threads_to_launch_with(const Arguments& arguments) {
  return arguments.run.launch.empty() ? threads_of_stage(arguments.threads) : arguments.threads;
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

// What make would run, by the programs as they are. Writes nothing.
int plan(Arguments& arguments, const Graph& graph) {
  const std::vector<Freshness> freshness = freshness_of(arguments.workspace, graph);
  if (count_stale(freshness) == 0) nothing_to_do(arguments, graph);
  arguments.run.threads = threads_to_launch_with(arguments);
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

// What stages read besides artifacts, or would, and is not there.
int missing(const Arguments& arguments, const Graph& graph) {
  std::set<fs::path> files;
  for (const Node& node : graph)
    for (const auto* named : {&node.sources, &node.wished})
      for (const std::string& source : *named)
        if (const fs::path path = arguments.workspace.repository / source; !fs::exists(path))
          files.insert(path);
  for (const fs::path& file : files) fmt::print("{}\n", file.string());
  return 0;
}

int run(Arguments& arguments) {
  const RunMeter meter;
  if (const char* make_process = std::getenv("HBR_MAKE"); make_process && arguments.handover.empty()) {
    end_with_parent(std::atoi(make_process));
    leave_lock_to_parent();
  }
  arguments.workspace.remember = true;
  arguments.run.threads = threads_to_launch_with(arguments);
  arguments.run.counted = std::getenv("HBR_MAKE") != nullptr;
  std::vector<Node> nodes;
  for (const std::string& output : arguments.outputs) {
    Node named;
    named.output = output;
    nodes.push_back(read_slice(slice_path(arguments.workspace.out, named)));
  }
  if (!arguments.handover.empty()) {
    const char* where = "--handover";
    arguments.run.handover = settings_from_json<Handover>(parse_json(arguments.handover, where), where);
    arguments.run.launch.clear();
    const int code = run_nodes(arguments.workspace, nodes, arguments.run);
    write_record(arguments.record, meter.read(code, std::max(1, arguments.run.threads)));
    return code;
  }
  if (nodes.size() == 1 || arguments.run.launch.empty())
    return run_nodes(arguments.workspace, nodes, arguments.run);
  std::vector<std::string> runner{fs::read_symlink("/proc/self/exe").string(),
                                  "run",
                                  "--out",
                                  arguments.workspace.out.string(),
                                  "--programs",
                                  arguments.workspace.programs.string(),
                                  "--repository",
                                  arguments.workspace.repository.string(),
                                  "--threads",
                                  std::to_string(arguments.threads),
                                  "--retry",
                                  std::to_string(arguments.run.retries),
                                  "--version",
                                  arguments.run.version};
  runner.insert(runner.end(), arguments.outputs.begin(), arguments.outputs.end());
  runner.push_back("--handover");
  return launch_nodes(arguments.workspace, nodes, arguments.run, runner);
}

int tell_audit(const Arguments& arguments, const Graph& graph) {
  const Audit found = audit(arguments.workspace, graph);
  for (const std::string& problem : found.problems) fmt::print(stderr, "{}\n", problem);
  fmt::print("{}\n", found.summary);
  return found.problems.empty() ? 0 : 1;
}

// A number that users give by a variable of make.
template <class Number>
CLI::Option* add_number(CLI::App* command, const char* option, const char* variable, Number most,
                        Number& value, const char* meaning) {
  return command->add_option_function<std::string>(
      option,
      [=, &value](const std::string& word) {
        const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
        if (error != std::errc() || end != word.data() + word.size() || !(value >= 0 && value <= most))
          throw InputError("{} is '{}': expected a {}number from 0 to {} ({})", variable, word,
                           std::is_integral_v<Number> ? "whole " : "", most, meaning);
      },
      meaning);
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
    add_number(command, "--threads", "THREADS", 4096, a.threads,
               "threads of one stage program; 0: what there is")
        ->envname("HBR_THREADS");
    command->add_option("--launch", a.run.launch, "words before every stage program")->envname("HBR_LAUNCH");
    add_number(command, "--retry", "RETRY", 100, a.run.retries, "how often a failed stage is tried again")
        ->envname("HBR_RETRY");
    return command;
  };
  const auto add_for_profile = [&](const char* name, const char* meaning) {
    CLI::App* command = add(name, meaning);
    command->add_option("--profile", a.profile, "profile (TOML)")->required();
    add_number(command, "--replication", "REP", 9999, a.replication,
               "only this replication of the goals' stages");
    command->add_option("goals", a.goals, "stages, families of stages, or all");
    return command;
  };
  CLI::App* const make_command = add_for_profile("make", "make what is not fresh (through make)");
  add_number(make_command, "--group", "GROUP", 1e9, a.group,
             "seconds of a replication's stages that are run by one launch");
  make_command->add_option("--make", a.make, "the make to use");
  make_command->add_option("--parent", a.parent, "the process with which to end");
  CLI::App* const plan_command = add_for_profile("plan", "check the profile and list what make would run");
  CLI::App* const missing_command = add_for_profile("missing", "list the files that stages read and lack");
  CLI::App* const status_command = add_for_profile("status", "tell what is fresh, stale or missing, and why");
  CLI::App* const audit_command =
      add_for_profile("audit", "read every artifact again and compare it with its manifest");
  CLI::App* const graph_command = add_for_profile("graph", "the stage graph as Graphviz text");
  CLI::App* const run_command = add("run", "make some artifacts (called by make)");
  run_command->add_option("outputs", a.outputs, "the artifacts, below the output folder")->required();
  run_command->add_option("--handover", a.handover, "of the runner that launched this one (JSON)");
  run_command->add_option("--record", a.record, "where to leave the record of this run");
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
    // A make's user may write two; the shell takes them for a number of its own.
    if (a.run.launch.find("$$") != std::string::npos)
      throw InputError("LAUNCH='{}': write one $ before a variable's name, the whole in single quotes",
                       a.run.launch);
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
