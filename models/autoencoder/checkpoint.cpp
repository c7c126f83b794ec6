#include "models/autoencoder/checkpoint.h"

#include <algorithm>
#include <cmath>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/temporary.h"
#include "pipeline/core/check.h"

namespace hbr::net {
namespace {

constexpr double kNotTested = -1;  // stands for the error of an epoch without a test

void write_floats(Hdf5Writer& file, const char* name, const Floats& values) {
  file.write(name, {values.size()}, values.data());
}

template <class T>
std::vector<T> read_values(const Hdf5Reader& file, const char* name) {
  return file.read<T>(name).values;
}

Floats read_floats(const Hdf5Reader& file, const char* name, std::size_t expected) {
  const std::vector<float> values = read_values<float>(file, name);
  const bool finite = std::all_of(values.begin(), values.end(), [](float x) { return std::isfinite(x); });
  if (values.size() != expected || !finite)
    throw InputError("{}: {}: expected {} finite numbers", file.path().string(), name, expected);
  return Floats(values.begin(), values.end());
}

}  // namespace

TrainingState::TrainingState(const AutoencoderSettings& settings, Seed seed, std::vector<std::int64_t> all)
    : network(settings.latent_size, activations_of(settings)),
      adam(network.parameters.size()),
      samples(std::move(all)) {
  network.initialise(seed, static_cast<float>(settings.output_bias));
  kept_per_class.fill(1);
}

void write_checkpoint(const std::filesystem::path& path, const std::string& identity,
                      const TrainingState& state) {
  const Temporary fresh(temporary_beside(path));
  Hdf5Writer file(fresh.path);
  file.attribute("identity", identity);
  write_floats(file, "parameters", state.network.parameters);
  write_floats(file, "adam/mean", state.adam.mean);
  write_floats(file, "adam/square", state.adam.square);
  file.write("samples", state.samples);
  std::vector<std::int64_t> epoch_samples;
  std::vector<double> errors;
  for (const EpochReport& e : state.epochs) {
    epoch_samples.push_back(e.samples);
    errors.insert(errors.end(), {e.train_error, e.test_error.value_or(kNotTested)});
  }
  file.write("epochs/samples", epoch_samples);
  file.write("epochs/errors", errors);
  file.write("kept_per_class", {10}, state.kept_per_class.data());
  file.write("adam/steps", std::vector<std::int64_t>{state.adam.steps});
  file.close();
  std::error_code error;
  std::filesystem::rename(fresh.path, path, error);
  if (error) throw InputError("{}: can't be written: {}", path.string(), error.message());
}

void read_checkpoint(const std::filesystem::path& path, const std::string& identity, TrainingState& state) {
  const Hdf5Reader file(path);
  const auto bad = [&](const char* what) { return InputError("{}: {}", path.string(), what); };
  if (!file.has_attribute("identity") || file.text_attribute("identity") != identity)
    throw bad("belongs to another training");
  TrainingState read = state;
  read.network.parameters = read_floats(file, "parameters", state.network.parameters.size());
  read.adam.mean = read_floats(file, "adam/mean", state.adam.mean.size());
  read.adam.square = read_floats(file, "adam/square", state.adam.square.size());
  const auto steps = read_values<std::int64_t>(file, "adam/steps");
  read.samples = read_values<std::int64_t>(file, "samples");
  const auto epoch_samples = read_values<std::int64_t>(file, "epochs/samples");
  const auto errors = read_values<double>(file, "epochs/errors");
  const auto kept = read_values<double>(file, "kept_per_class");
  const auto count = static_cast<std::int64_t>(state.samples.size());
  if (steps.size() != 1 || kept.size() != 10 || errors.size() != 2 * epoch_samples.size() ||
      read.samples.empty() ||
      std::any_of(read.samples.begin(), read.samples.end(), [&](auto i) { return i < 0 || i >= count; }))
    throw bad("is damaged");
  read.adam.steps = steps[0];
  std::copy(kept.begin(), kept.end(), read.kept_per_class.begin());
  for (std::size_t i = 0; i < epoch_samples.size(); ++i) {
    read.epochs.push_back({static_cast<int>(i) + 1, epoch_samples[i], errors[2 * i], {}});
    if (errors[2 * i + 1] != kNotTested) read.epochs.back().test_error = errors[2 * i + 1];
  }
  read.network.refresh();
  state = std::move(read);
}

}  // namespace hbr::net
