#include <algorithm>
#include <cstdlib>

#include "pipeline/artifact/group.h"
#include "pipeline/artifact/json_file.h"
#include "pipeline/artifact/lock.h"
#include "pipeline/artifact/plan.h"
#include "pipeline/artifact/record.h"
#include "pipeline/artifact/tool_commands.h"
#include "pipeline/core/settings.h"
#include "pipeline/process/child.h"

namespace hbr::inline artifact {
namespace fs = std::filesystem;

int run_artifacts(ToolArguments& arguments) {
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

}  // namespace hbr::inline artifact
