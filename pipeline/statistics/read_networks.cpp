#include <algorithm>
#include <cmath>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/curves.h"
#include "pipeline/statistics/readers.h"

namespace hbr::inline statistics {
namespace {

struct Training {
  std::vector<std::int64_t> epoch, samples, tested;
  std::vector<double> train_error, test_error;
};

Training read_training(const Hdf5Reader& file) {
  Training training{
      file.read<std::int64_t>("training/epoch").values, file.read<std::int64_t>("training/samples").values,
      file.read<std::int64_t>("training/tested").values, file.read<double>("training/train_error").values,
      file.read<double>("training/test_error").values};
  const std::size_t n = training.epoch.size();
  if (n == 0 || training.samples.size() != n || training.train_error.size() != n || training.tested.empty() ||
      training.test_error.size() != training.tested.size())
    throw InputError("{}: the arrays of training/ differ in length or are empty", file.path().string());
  if (training.samples.front() <= 0)
    throw InputError("{}: training/samples starts with {}; expected more than 0", file.path().string(),
                     training.samples.front());
  if (training.tested.back() != training.epoch.back() ||
      !std::ranges::includes(training.epoch, training.tested))
    throw InputError("{}: training/tested: expected some of training/epoch, ascending, the last among them",
                     file.path().string());
  return training;
}

Course course(const std::vector<std::int64_t>& epoch, const std::vector<double>& values) {
  Course result;
  for (std::size_t i = 0; i < epoch.size(); ++i)
    result.emplace_back(static_cast<double>(epoch[i]), values[i]);
  return result;
}

// Where the epochs of the whole course were tested.
Course tested(const Course& whole, const std::vector<std::int64_t>& epochs) {
  Course result;
  std::ranges::copy_if(whole, std::back_inserter(result), [&](const auto& point) {
    return std::ranges::binary_search(epochs, static_cast<std::int64_t>(point.first));
  });
  return result;
}

}  // namespace

void read_autoencoders(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  std::vector<Course> train_error, test_error;
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    const int replication = artifact.name.replication;
    const Training training = read_training(file);
    table.number("autoencoder.epochs", static_cast<double>(training.epoch.back()));
    table.add("autoencoder.test_error", replication, training.test_error.back());
    table.add("autoencoder.kept", replication,
              static_cast<double>(training.samples.back()) / static_cast<double>(training.samples.front()));
    train_error.push_back(tested(course(training.epoch, training.train_error), training.tested));
    test_error.push_back(course(training.tested, training.test_error));

    const std::vector<double> kept = file.read<double>("training/kept_per_class").values;
    for (std::size_t c = 0; c < kept.size(); ++c)
      table.add(fmt::format("autoencoder.kept_of_class.{}", c), replication, kept[c]);

    double reach = 0;
    for (const float z : file.read<float>("latent/position").values)
      reach = std::max(reach, std::abs(static_cast<double>(z)));
    table.add("autoencoder.reach", replication, reach);
  }
  if (artifacts.empty()) return;
  add_curve(table, "autoencoder", "epoch", "train_error", train_error);
  add_curve(table, "autoencoder", "epoch", "test_error", test_error);
}

void read_descriptor(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  for (const Artifact& artifact : artifacts)
    table.number("descriptor.test_error", Hdf5Reader(artifact.path).number_attribute("test_error"));
}

void read_judge(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  for (const Artifact& artifact : artifacts)
    for (const char* figure : {"test_accuracy", "test_typical", "random_typical"})
      table.number(std::string("judge.") + figure, Hdf5Reader(artifact.path).number_attribute(figure));
}

}  // namespace hbr::inline statistics
