#include "reports/kept/lineage.h"

#include <vector>

#include "pipeline/core/check.h"

namespace hbr::inline reports {

std::map<std::string, Manifest> lineage(const std::filesystem::path& out, const std::string& output) {
  std::map<std::string, Manifest> found;
  std::vector<std::string> waiting{output};
  while (!waiting.empty()) {
    Node node;
    node.output = waiting.back();
    waiting.pop_back();
    if (found.contains(node.output)) continue;
    try {
      const Manifest& manifest = found[node.output] = read_manifest(manifest_path(out, node));
      for (const auto& [name, input] : manifest.slice.inputs) {
        if (!manifest.made_from.inputs.contains(name))
          throw InputError("{}: inputs: expected the hash of '{}', which its slice names",
                           manifest_path(out, node).string(), name);
        waiting.push_back(input);
      }
    } catch (const InputError& problem) {
      throw InputError("{}; `make all` of the profile makes {} again", problem.what(), node.output);
    }
  }
  return found;
}

}  // namespace hbr::inline reports
