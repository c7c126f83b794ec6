// A stage that does next to nothing, to try the runner with: adds up its inputs and its own number, slowly if
// asked, and keeps a checkpoint.
#include <chrono>
#include <fstream>
#include <thread>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/core/check.h"
#include "tests/end_to_end/fake_experiment.h"

namespace hbr {
namespace {

double read_value(const std::filesystem::path& path) { return Hdf5Reader(path).number_attribute("value"); }

void write_value(const std::filesystem::path& path, const FakeSettings& settings, double value) {
  Hdf5Writer file(path);
  file.write("values", std::vector<double>(static_cast<std::size_t>(settings.size), value));
  file.attribute("value", value);
  file.close();
}

void run(StageRun& stage) {
  const auto settings = stage.settings_as<FakeSettings>();
  double value = settings.number;
  for (const std::string& name : stage.inputs()) value += read_value(stage.input(name));

  int step = 0;
  std::ifstream(stage.checkpoint()) >> step;
  for (; step < settings.steps; ++step) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    const std::string temporary = stage.checkpoint().string() + ".new";
    std::ofstream(temporary) << step;
    std::filesystem::rename(temporary, stage.checkpoint());
    stage.progress(step, settings.steps, "steps");
  }
  if (settings.behaviour == "refuses") throw InputError("{}: the fake input is wrong", stage.name());
  if (settings.behaviour == "leaves nothing") return;
  if (settings.behaviour == "crashes") std::abort();
  if (settings.behaviour == "leaves a folder") {
    std::filesystem::create_directories(stage.output() / "deep");
    write_value(stage.output() / "deep/a.h5", settings, value);
    write_value(stage.output() / "b.h5", settings, value);
    return;
  }
  write_value(stage.output(), settings, value);
}

}  // namespace
}  // namespace hbr

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "A stage for tests", hbr::run); }
