// Words for LAUNCH, made for a test.
#pragma once

#include <string>

#include "pipeline/artifact/manifest.h"
#include "tests/end_to_end/fake_folder.h"

namespace hbr {

// A script in the folder, as words for LAUNCH. In it, "$@" is the stage's command line.
inline std::string launcher(const FakeFolder& folder, const std::string& script) {
  const std::filesystem::path path = folder.path / "launcher";
  std::ofstream(path) << "#!/bin/bash\n" << script << "\n";
  std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  return "--launch " + path.string();
}

inline nlohmann::json run_facts(const FakeFolder& folder, const std::string& name) {
  return read_manifest(folder.out() / (name + ".json")).run;
}

}  // namespace hbr
