// The slice that tells a stage program what to do.
#include "pipeline/artifact/stage.h"
#include "tests/fuzz/fuzz.h"

namespace hbr::fuzz {
namespace {

struct Settings {
  std::uint64_t seed;
  int generations;
  double spacing;
  std::string selector;
  std::vector<double> starts;
};
template <class Fields>
void describe(Fields& f, Settings& s) {
  f.number("seed", s.seed, Range{0, 1e19}, "of all random numbers");
  f.number("generations", s.generations, Range{1, 1e9}, "of the search");
  f.number("spacing", s.spacing, Range{1e-6, 1}, "between elites");
  f.choice("selector", s.selector, {"curiosity", "uniform"}, "how parents are drawn");
  f.numbers("starts", s.starts, Range{-1, 1}, "where to begin");
}

}  // namespace

std::vector<std::string> examples() {
  return {
      R"({"stage": "layer2", "name": "layer2/03", "inputs": {"layer1": "layer1/03.h5"}, "output": "layer2/03.h5",
 "settings": {"seed": 7, "generations": 100, "spacing": 0.25, "selector": "uniform", "starts": [0.5, -1]}})"};
}

void read(const std::string& bytes) {
  const StageRun stage(written("slice.json", bytes), folder(), folder() / "output", folder() / "checkpoint",
                       1);
  stage.settings_as<Settings>();
  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  for (const std::string& name : stage.inputs()) stage.input(name);
}

}  // namespace hbr::fuzz
