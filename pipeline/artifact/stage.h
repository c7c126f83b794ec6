// A stage: artifacts in, one artifact out. The main of a stage program is
//
//   int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Layer 1: points", run); }
//
// with void run(hbr::StageRun& stage). The runner calls
//
//   PROGRAM --root OUT --slice SLICE --output PATH --checkpoint PATH --threads N --record PATH --program
//   SHA256
//
// where the slice (JSON) holds "stage", "name", "settings", "inputs" (name -> path below OUT) and "output".
// The program refuses to run where it is not the one of that hash, and leaves the record of its run
// (record.h); for whoever calls it by hand the last two are optional. InputError ends the program with one
// line on stderr and exit code 2.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/slice.h"
#include "pipeline/core/settings.h"

namespace hbr::inline artifact {

class Progress;

class StageRun {
 public:
  // Reads the slice; throws InputError where it is missing or not as expected.
  StageRun(const std::filesystem::path& slice, std::filesystem::path root, std::filesystem::path output,
           std::filesystem::path checkpoint, int threads);
  ~StageRun();

  const std::string& stage() const { return told_.stage; }  // the program's task: "layer2_n10"
  const std::string& name() const { return told_.name; }    // this instance: "layer2_n10/03"
  const nlohmann::json& settings() const { return told_.settings; }
  // The settings as a struct described as in settings.h.
  template <class S>
  S settings_as() const {
    return settings_from_json<S>(told_.settings, slice_.string());
  }
  // Keeps them as attributes of the artifact: `stage`, `settings` (JSON), and each value as `settings.` and
  // its dotted name.
  void write_settings(Hdf5Writer& file) const;

  // The artifact of that name; throws InputError where the slice or the disk has none.
  std::filesystem::path input(const std::string& name) const;
  bool has_input(const std::string& name) const;
  // All inputs' names, sorted.
  std::vector<std::string> inputs() const;

  // Where to write: a temporary name that the runner renames when the program succeeds. A stage that leaves a
  // folder makes it itself.
  const std::filesystem::path& output() const { return output_; }
  // Where state may be kept that a killed run goes on from; gone when the stage succeeds.
  const std::filesystem::path& checkpoint() const { return checkpoint_; }
  int threads() const { return threads_; }

  // Tells how far the run is: rate and time left, see progress.h.
  void progress(std::int64_t done, std::int64_t total, const char* unit);

 private:
  std::filesystem::path slice_, root_, output_, checkpoint_;
  Slice told_;
  int threads_;
  std::unique_ptr<Progress> progress_;
};

int stage_main(int argc, char** argv, const char* summary, const std::function<void(StageRun&)>& run);

}  // namespace hbr::inline artifact
