// The slice that tells a stage program what to do, as the runner and the program read it.
#include "pipeline/artifact/slice.h"

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
  Node node{"layer2", "layer2", 3, "layer2/03.h5", {}, {{"layer1", "layer1/03.h5"}}, {"source"}};
  node.settings = {
      {"seed", 7}, {"generations", 100}, {"spacing", 0.25}, {"selector", "uniform"}, {"starts", {0.5, -1}}};
  write_slice(folder(), node);
  return {content_of_file(slice_path(folder(), node))};
}

void read(const std::string& bytes) {
  const std::filesystem::path path = written("slice.json", bytes);
  and_go_on([&] { read_slice(path); });
  const StageRun stage(path, folder(), folder() / "output", folder() / "checkpoint", 1);
  and_go_on([&] { stage.settings_as<Settings>(); });
  Hdf5Writer file(stage.output());
  and_go_on([&] { stage.write_settings(file); });
  for (const std::string& name : stage.inputs()) and_go_on([&] { stage.input(name); });
}

}  // namespace hbr::fuzz
