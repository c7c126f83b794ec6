// The profile, with what it builds on, up to the graph of its stages.
#include "stages/experiment.h"
#include "tests/fuzz/fuzz.h"

namespace hbr::fuzz {

std::vector<std::string> examples() {
  const std::filesystem::path profiles = HBR_SOURCE_DIR "/stages/profiles";
  std::vector<std::string> all = {
      "base = \"lines.toml\"\nname = \"mine\"\nseed = 7\n[layer1]\ngenerations = 2000\n",
      "base = \"lines.toml\"\nname = \"mine\"\n[[variations]]\nname = \"short\"\nchanges = \"Lines.\"\n"
      "set.longest_line = 0.15\nset.layer3.spacing = 0.04\n"};
  for (const auto& entry : std::filesystem::directory_iterator(profiles)) {
    written(entry.path().filename().string(), content_of_file(entry.path()));  // for whoever builds on it
    all.push_back(content_of_file(entry.path()));
  }
  return all;
}

void read(const std::string& bytes) { experiment_graph(written("profile", bytes)); }

}  // namespace hbr::fuzz
