// The profile, with what it builds on, up to the graph of its stages.
#include "stages/plan/experiment.h"
#include "tests/fuzz/fuzz.h"

namespace hbr::fuzz {

namespace {

// The project's own, for whoever builds on them.
std::vector<std::string> profiles() {
  std::vector<std::string> all;
  for (const auto& entry : std::filesystem::directory_iterator(HBR_SOURCE_DIR "/stages/profiles")) {
    all.push_back(content_of_file(entry.path()));
    written(entry.path().filename().string(), all.back());
  }
  return all;
}

}  // namespace

std::vector<std::string> examples() {
  std::vector<std::string> all = {
      "base = \"lines.toml\"\nname = \"mine\"\nseed = 7\n[layers.layer1]\ngenerations = 2000\n",
      "base = \"lines.toml\"\nname = \"mine\"\n[[variations]]\nname = \"short\"\nchanges = \"Lines.\"\n"
      "set.longest_line = 0.15\nset.layer3.spacing = 0.04\n"};
  for (std::string& profile : profiles()) all.push_back(std::move(profile));
  return all;
}

void read(const std::string& bytes) {
  static const std::vector<std::string> bases = profiles();
  experiment_graph(written("profile", bytes));
}

}  // namespace hbr::fuzz
