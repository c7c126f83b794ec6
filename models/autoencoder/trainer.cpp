#include "models/autoencoder/trainer.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "models/autoencoder/checkpoint.h"
#include "models/autoencoder/collapse.h"
#include "models/autoencoder/gradient.h"
#include "pipeline/core/check.h"

namespace hbr::inline autoencoder {
namespace {

using net::TrainingState;

std::vector<std::int64_t> all_samples(const AutoencoderSettings& settings, const ImageSet& train) {
  std::vector<std::int64_t> all(settings.training_samples > 0 ? settings.training_samples : train.count);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

// Steps from which on a network that does no better than the mean image has failed.
constexpr std::int64_t kStepsToLearn = 1000;

class Trainer {
 public:
  Trainer(const AutoencoderSettings& settings, Seed seed, const ImageSet& train, const ImageSet& test,
          Workers& workers, TrainingState& state)
      : settings_(settings),
        seed_(seed),
        train_(train),
        test_(test),
        workers_(workers),
        state_(state),
        gradient_(state.network.layout) {
    mean_image_error_ = mean_image_error();
  }

  void epoch() {
    EpochReport report;
    report.epoch = static_cast<int>(state_.epochs.size()) + 1;
    report.samples = static_cast<std::int64_t>(state_.samples.size());
    report.train_error = learn(report.epoch);
    if (report.epoch == 1 || report.epoch == settings_.epochs || report.epoch % settings_.test_every == 0)
      report.test_error = evaluate(report.epoch);
    state_.epochs.push_back(report);
    const bool again = settings_.cut == "every_epoch" && settings_.cut_after > 0;
    if (report.epoch == settings_.epochs) return;
    if (report.epoch == settings_.cut_after || (again && report.epoch > settings_.cut_after)) cut();
  }

 private:
  const std::uint8_t* image(std::int64_t i) const { return train_.images + i * net::kPixels; }
  std::string where(int epoch) const { return fmt::format("seed {:#x}, epoch {}", seed_.key(), epoch); }

  // One pass in a new order; the mean error.
  double learn(int epoch) {
    std::vector<std::int64_t> order = state_.samples;
    Rng rng(seed_.child("shuffle").child(static_cast<std::uint64_t>(epoch)));
    for (std::size_t i = order.size(); i > 1; --i)
      std::swap(order[i - 1], order[rng.below(static_cast<std::uint32_t>(i))]);
    std::vector<const std::uint8_t*> images(order.size());
    std::transform(order.begin(), order.end(), images.begin(), [&](std::int64_t i) { return image(i); });

    const double rate = settings_.learning_rate * std::pow(0.5, (epoch - 1) / settings_.halve_every);
    double error = 0;
    for (std::size_t i = 0; i < images.size(); i += static_cast<std::size_t>(settings_.batch)) {
      const std::size_t n = std::min(static_cast<std::size_t>(settings_.batch), images.size() - i);
      error += step(images.data() + i, static_cast<int>(n), rate);
      if (!std::isfinite(error))
        throw InputError("{}: the training diverged; use a learning_rate below {}", where(epoch), rate);
    }
    return error / static_cast<double>(images.size());
  }

  // Returns the sum of the errors before the step.
  double step(const std::uint8_t* const* images, int n, double rate) {
    const double error = gradient_.find(state_.network, n, images, 1.f / static_cast<float>(n), workers_);
    state_.adam.step(rate, gradient_.gradient(), state_.network.parameters, workers_);
    state_.network.refresh();
    return error;
  }

  // Latent positions and errors of images.
  void describe(const std::vector<const std::uint8_t*>& images, std::vector<float>& latent,
                std::vector<float>& error) {
    const Autoencoder autoencoder(state_.network);
    const auto dim = static_cast<std::size_t>(autoencoder.dimension());
    latent.resize(images.size() * dim);
    error.resize(images.size());
    workers_.for_ranges(images.size(), 256, [&](std::size_t begin, std::size_t end) {
      autoencoder.describe(static_cast<Eigen::Index>(end - begin), images.data() + begin,
                           latent.data() + begin * dim, error.data() + begin);
    });
  }

  double evaluate(int epoch) {
    std::vector<const std::uint8_t*> images;
    for (std::int64_t i = 0; i < test_.count; ++i) images.push_back(test_.images + i * net::kPixels);
    std::vector<float> latent, error;
    describe(images, latent, error);
    double sum = 0;
    for (float e : error) sum += e;
    const double mean = sum / static_cast<double>(test_.count);
    if (!std::isfinite(mean))
      throw InputError("{}: the training diverged; use a lower learning_rate", where(epoch));
    const bool learned = state_.adam.steps >= kStepsToLearn;
    net::refuse_collapse(latent, mean, mean_image_error_, learned, where(epoch));
    return mean;
  }

  // Keeps the samples whose error is below the mean, of those that there are or of all.
  void cut() {
    std::vector<std::int64_t> candidates = state_.samples;
    if (settings_.cut == "every_epoch") candidates = all_samples(settings_, train_);
    std::vector<const std::uint8_t*> images;
    for (std::int64_t i : candidates) images.push_back(image(i));
    std::vector<float> latent, error;
    describe(images, latent, error);
    double sum = 0;
    for (float e : error) sum += e;
    const double mean = sum / static_cast<double>(error.size());
    std::vector<std::int64_t> kept;
    std::array<double, 10> before{}, after{};
    for (std::size_t k = 0; k < error.size(); ++k) {
      const std::int64_t i = candidates[k];
      before[train_.labels[i]] += 1;
      if (error[k] >= mean) continue;
      after[train_.labels[i]] += 1;
      kept.push_back(i);
    }
    if (kept.empty()) return;  // all errors are equal
    for (std::size_t c = 0; c < 10; ++c) state_.kept_per_class[c] = before[c] > 0 ? after[c] / before[c] : 1;
    state_.samples = std::move(kept);
  }

  // Of the test images, when the mean of the training images stands for each of them.
  double mean_image_error() const {
    std::vector<double> mean(net::kPixels, 0.);
    for (std::int64_t i : state_.samples)
      for (std::size_t p = 0; p < mean.size(); ++p) mean[p] += image(i)[p];
    for (double& m : mean) m /= 255. * static_cast<double>(state_.samples.size());
    double sum = 0;
    for (std::int64_t i = 0; i < test_.count; ++i)
      for (std::size_t p = 0; p < mean.size(); ++p) {
        const double d = test_.images[i * net::kPixels + static_cast<std::int64_t>(p)] / 255. - mean[p];
        sum += d * d;
      }
    return sum / (static_cast<double>(test_.count) * net::kPixels);
  }

  const AutoencoderSettings& settings_;
  const Seed seed_;
  const ImageSet& train_;
  const ImageSet& test_;
  Workers& workers_;
  TrainingState& state_;
  net::BatchGradient gradient_;
  double mean_image_error_ = 0;
};

void check_images(const ImageSet& set, const char* what) {
  if (set.count < 1) throw InputError("no {} images", what);
  const auto* label = std::find_if(set.labels, set.labels + set.count, [](std::uint8_t l) { return l > 9; });
  if (label != set.labels + set.count)
    throw InputError("{} image {}: label {}, expected 0 to 9", what, label - set.labels, *label);
}

std::uint64_t fingerprint(const std::uint8_t* bytes, std::int64_t count) {
  return Seed(0)
      .child(std::string_view(reinterpret_cast<const char*>(bytes), static_cast<std::size_t>(count)))
      .key();
}

std::string identity_of(const AutoencoderSettings& settings, Seed seed, const ImageSet& train,
                        const ImageSet& test) {
  return fmt::format("{} {:x} {:x} {:x} {:x}", settings_to_json(settings).dump(), seed.key(),
                     fingerprint(train.images, train.count * net::kPixels),
                     fingerprint(train.labels, train.count),
                     fingerprint(test.images, test.count * net::kPixels));
}

}  // namespace

net::Activations activations_of(const AutoencoderSettings& settings) {
  return {static_cast<float>(settings.leak), settings.hidden == "tanh", settings.output == "linear"};
}

TrainedAutoencoder train_autoencoder(const AutoencoderSettings& settings, Seed seed, const ImageSet& train,
                                     const ImageSet& test, Workers& workers, const TrainingHooks& hooks) {
  check_images(train, "training");
  check_images(test, "test");
  if (settings.training_samples > train.count)
    throw InputError("training_samples is {}, but there are only {} training images",
                     settings.training_samples, train.count);
  TrainingState state(settings, seed, all_samples(settings, train));
  Trainer trainer(settings, seed, train, test, workers, state);

  const std::string identity = hooks.checkpoint.empty() ? "" : identity_of(settings, seed, train, test);
  if (!hooks.checkpoint.empty() && std::filesystem::exists(hooks.checkpoint)) try {
      net::read_checkpoint(hooks.checkpoint, identity, state);
    } catch (const InputError& e) {
      if (hooks.on_message) hooks.on_message(fmt::format("checkpoint ignored: {}", e.what()));
    }
  while (static_cast<int>(state.epochs.size()) < settings.epochs) {
    trainer.epoch();
    if (!hooks.checkpoint.empty()) net::write_checkpoint(hooks.checkpoint, identity, state);
    if (hooks.on_epoch) hooks.on_epoch(state.epochs.back());
  }
  return {Autoencoder(std::move(state.network)), std::move(state.epochs), state.kept_per_class};
}

}  // namespace hbr::inline autoencoder
