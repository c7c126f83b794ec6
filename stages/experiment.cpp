#include "stages/experiment.h"

#include "pipeline/artifact/profile.h"

namespace hbr {

Graph experiment_graph(const std::filesystem::path& profile_file) {
  read_toml(profile_file);
  return {};
}

}  // namespace hbr
