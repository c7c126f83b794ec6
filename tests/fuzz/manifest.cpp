// The manifest beside an artifact, as make and its audit read it.
#include "pipeline/artifact/manifest.h"

#include "pipeline/artifact/freshness.h"
#include "pipeline/artifact/status.h"
#include "tests/fuzz/fuzz.h"

namespace hbr::fuzz {
namespace {

const Node kNode{"program", "layer1", 0, "artifact.h5", {{"seed", 7}, {"spacing", 0.25}}, {}, {"source"}};
const Workspace& workspace() {
  static const Workspace all = [] {
    for (const char* name : {"program", "source", "artifact.h5"}) written(name, name);
    return Workspace{folder(), folder(), folder()};
  }();
  return all;
}

}  // namespace

std::vector<std::string> examples() {
  const Freshness is = freshness_of(workspace(), {kNode})[0];
  const std::filesystem::path artifact = folder() / kNode.output, path = manifest_path(folder(), kNode);
  write_manifest(
      path, {is.ingredients, {}, is.key, content_of(artifact), fingerprint(artifact), {{"seconds", 1.5}}});
  return {content_of_file(path)};
}

void read(const std::string& bytes) {
  written("artifact.json", bytes);
  and_go_on([] { status_table({kNode}, freshness_of(workspace(), {kNode})); });
  audit(workspace(), {kNode});
}

}  // namespace hbr::fuzz
