#include "pipeline/artifact/stage.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/json_file.h"
#include "pipeline/artifact/program.h"
#include "pipeline/artifact/progress.h"
#include "pipeline/artifact/record.h"
#include "pipeline/artifact/threads.h"
#include "pipeline/core/check.h"

namespace hbr::inline artifact {
namespace {

// A list of numbers or of texts as such, any other as JSON.
void write_list(Hdf5Writer& file, const std::string& name, const nlohmann::json& list) {
  const auto all = [&](auto is) { return std::ranges::all_of(list, is); };
  if (all([](const auto& value) { return value.is_number_integer(); }) && !list.empty())
    file.attribute(name, list.get<std::vector<std::int64_t>>());
  else if (all([](const auto& value) { return value.is_number(); }))
    file.attribute(name, list.get<std::vector<double>>());
  else if (all([](const auto& value) { return value.is_string(); }))
    file.attribute(name, list.get<std::vector<std::string>>());
  else
    file.attribute(name, list.dump());
}

// One attribute for each value of a table.
void write_values(Hdf5Writer& file, const std::string& name, const nlohmann::json& value) {
  if (value.is_object())
    for (const auto& [key, inner] : value.items()) write_values(file, name + "." + key, inner);
  else if (value.is_array())
    write_list(file, name, value);
  else if (value.is_number_float())
    file.attribute(name, value.get<double>());
  else if (value.is_boolean())
    file.attribute(name, std::int64_t{value.get<bool>()});
  else if (value.is_number())
    file.attribute(name, value.get<std::int64_t>());
  else
    file.attribute(name, value.is_string() ? value.get<std::string>() : value.dump());
}

// The runner knows which program an artifact is to be made by; by now it may have been built anew.
void check_program(const std::string& expected) {
  if (!expected.empty() && sha256_of_program("/proc/self/exe") != expected)
    throw InputError(
        "{}: this program was built anew after this run was decided on: give the same command again",
        std::filesystem::read_symlink("/proc/self/exe").string());
}

}  // namespace

StageRun::StageRun(const std::filesystem::path& slice, std::filesystem::path root,
                   std::filesystem::path output, std::filesystem::path checkpoint, int threads)
    : slice_(slice),
      root_(std::move(root)),
      output_(std::move(output)),
      checkpoint_(std::move(checkpoint)),
      told_(slice_from_json(read_json(slice), slice.string())),
      threads_(threads),
      progress_(std::make_unique<Progress>(told_.name)) {}

StageRun::~StageRun() = default;

bool StageRun::has_input(const std::string& name) const { return told_.inputs.contains(name); }

std::filesystem::path StageRun::input(const std::string& name) const {
  if (!has_input(name))
    throw InputError("{}: no input '{}'{}", slice_.string(), name, did_you_mean(name, inputs()));
  std::filesystem::path path = root_ / told_.inputs.at(name);
  if (!std::filesystem::exists(path))
    throw InputError("{}: missing, the input '{}' of {}: give the same make again, which makes it first",
                     path.string(), name, told_.name);
  return path;
}

std::vector<std::string> StageRun::inputs() const {
  std::vector<std::string> names;
  for (const auto& [name, path] : told_.inputs) names.push_back(name);
  return names;
}

void StageRun::write_settings(Hdf5Writer& file) const {
  file.attribute("stage", told_.stage);
  file.attribute("settings", told_.settings.dump());
  write_values(file, "settings", told_.settings);
}

void StageRun::progress(std::int64_t done, std::int64_t total, const char* unit) {
  progress_->show(done, total, unit);
}

int stage_main(int argc, char** argv, const char* summary, const std::function<void(StageRun&)>& run) {
  const RunMeter meter;
  CLI::App app(summary);
  std::filesystem::path slice, root, output, checkpoint, record;
  std::string program;
  int threads = 1;
  app.add_option("--root", root, "folder that the slice's paths are below")->required();
  app.add_option("--slice", slice, "the run's settings and inputs (JSON)")->required();
  app.add_option("--output", output, "where to write the artifact")->required();
  app.add_option("--checkpoint", checkpoint, "where to keep what a killed run goes on from")->required();
  app.add_option("--threads", threads, "threads to use; 0: the processors")->check(CLI::Range(0, 4096));
  app.add_option("--record", record, "where to tell the runner what the run cost (JSON)");
  app.add_option("--program", program, "the hash that this program is to have");
  CLI11_PARSE(app, argc, argv);
  std::string name = std::filesystem::path(argv[0]).filename().string();
  threads = threads_of_stage(threads);
  const int code = guarded_main(name, [&] {
    StageRun stage(slice, root, output, checkpoint, threads);
    name = stage.name();
    check_program(program);
    run(stage);
    // A network's server may say only now, and only to this host, that its disk is full.
    if (std::filesystem::exists(output)) sync_to_disk(output);
    return 0;
  });
  if (record.empty()) return code;
  const int told = guarded_main(name, [&] {
    write_record(record, meter.read(code, threads));
    return 0;
  });
  return code != 0 ? code : told;
}

}  // namespace hbr::inline artifact
