#include "pipeline/artifact/tool.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <set>

#include "pipeline/artifact/program.h"
#include "pipeline/artifact/selection.h"
#include "pipeline/artifact/status.h"
#include "pipeline/artifact/tool_commands.h"
#include "pipeline/core/check.h"
#include "pipeline/core/utf8.h"

namespace hbr::inline artifact {
namespace fs = std::filesystem;
namespace {

fs::path absolute_path(const fs::path& path) { return fs::absolute(path).lexically_normal(); }

// What make would run, by the programs as they are. Writes nothing.
int plan(ToolArguments& arguments, const Graph& graph) {
  const std::vector<Freshness> freshness = freshness_of(arguments.workspace, graph);
  if (count_stale(freshness) == 0) say_nothing_to_do(arguments, graph);
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
int missing(const ToolArguments& arguments, const Graph& graph) {
  std::set<fs::path> files;
  for (const Node& node : graph)
    for (const auto* named : {&node.sources, &node.wished})
      for (const std::string& source : *named)
        if (const fs::path path = arguments.workspace.repository / source; !fs::exists(path))
          files.insert(path);
  for (const fs::path& file : files) fmt::print("{}\n", file.string());
  return 0;
}

int tell_audit(const ToolArguments& arguments, const Graph& graph) {
  const Audit found = audit(arguments.workspace, graph);
  for (const std::string& problem : found.problems) fmt::print(stderr, "{}\n", problem);
  fmt::print("{}\n", found.summary);
  return found.problems.empty() && found.read > 0 ? 0 : 1;
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
  ToolArguments a;
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
    for (const auto& [what, text] : {std::pair{"OUT", a.workspace.out.string()},
                                     {"PROFILE", a.profile.string()},
                                     {"LAUNCH", a.run.launch},
                                     {"the folder of the programs", a.workspace.programs.string()},
                                     {"the folder of the sources", a.workspace.repository.string()}})
      if (!is_utf8(text))
        throw InputError("{} is '{}', which is not UTF-8, as the texts in manifests are; rename it", what,
                         as_utf8(text));
    // A make's user may write two; the shell takes them for a number of its own.
    if (a.run.launch.find("$$") != std::string::npos)
      throw InputError("LAUNCH='{}': write one $ before a variable's name, the whole in single quotes",
                       a.run.launch);
    if (run_command->parsed()) return run_artifacts(a);
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
    return make_artifacts(a, graph, all);
  });
}

}  // namespace hbr::inline artifact
