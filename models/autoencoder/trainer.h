// Trains the paper's autoencoder: mean squared error per pixel, Adam, after epoch `cut_after` only the
// samples whose error is below the mean (appendix of the paper; activations, optimiser, rate and batch are
// ours).
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "models/autoencoder/autoencoder.h"
#include "pipeline/core/parallel.h"
#include "pipeline/core/random.h"
#include "pipeline/core/settings.h"

namespace hbr::inline autoencoder {

struct AutoencoderSettings {
  int epochs = 200;
  int batch = 128;
  double learning_rate = 1e-3;
  int halve_every = 41;
  int cut_after = 120;
  std::string cut = "once";
  int latent_size = 2;
  std::string hidden = "leaky";
  double leak = 0.1;
  std::string output = "sigmoid";
  double output_bias = -2;
  std::int64_t training_samples = 0;
  int test_every = 1;
};

template <class Fields>
void describe(Fields& f, AutoencoderSettings& s) {
  f.number("epochs", s.epochs, Range{1, 1e5}, "passes over the training set");
  f.number("batch", s.batch, Range{1, 1e5}, "images of one step");
  f.number("learning_rate", s.learning_rate, Range{1e-8, 1}, "rate of Adam at the start");
  f.number("halve_every", s.halve_every, Range{1, 1e5},
           "epochs after which the rate is halved, again and again");
  f.number("cut_after", s.cut_after, Range{0, 1e5},
           "epoch after which the training set keeps the samples with an error below the mean; 0 for never");
  f.choice("cut", s.cut, {"once", "every_epoch"},
           "the samples to keep are chosen then, or from all after every epoch from then on");
  f.number("latent_size", s.latent_size, Range{1, net::kMaxLatent}, "dimensions of the latent space");
  f.choice("hidden", s.hidden, {"leaky", "tanh"}, "units between the layers: leaky rectifiers or tanh");
  f.number("leak", s.leak, Range{0, 1}, "slope of the leaky rectifiers below zero");
  f.choice("output", s.output, {"sigmoid", "linear"}, "units of the output");
  f.number("output_bias", s.output_bias, Range{-10, 10},
           "bias of the output at the start, about the logit of the mean brightness (of a linear output: "
           "about the mean brightness)");
  f.number("training_samples", s.training_samples, Range{0, 1e9},
           "how many of the training images to use, from the first; 0 for all");
  f.number("test_every", s.test_every, Range{1, 1e5},
           "epochs from one test to the next; the first and the last are always tested");
}

net::Activations activations_of(const AutoencoderSettings& settings);

// Images of 28 x 28 bytes and what they show (0 to 9).
struct ImageSet {
  std::int64_t count = 0;
  const std::uint8_t* images = nullptr;  // [count x 784]
  const std::uint8_t* labels = nullptr;  // [count]
};

struct EpochReport {
  int epoch = 0;  // from 1
  std::int64_t samples = 0;
  double train_error = 0;            // mean squared error per pixel, of each batch before its step
  std::optional<double> test_error;  // after the epoch, where it was tested
};

struct TrainedAutoencoder {
  Autoencoder autoencoder;
  std::vector<EpochReport> epochs;
  std::array<double, 10> kept_per_class;  // share that the cut kept, 1 where there was none
};

struct TrainingHooks {
  std::function<void(const EpochReport&)> on_epoch;    // may throw to end the training
  std::function<void(const std::string&)> on_message;  // a line worth telling
  // Written after each epoch; where it holds the state of this very training, the training goes on from it
  // and ends in the same bytes. A damaged or foreign one is ignored with a message. Empty for none.
  std::filesystem::path checkpoint;
};

// Throws InputError where the training diverges or, at a test, has collapsed (see collapse.h). The result
// depends on settings, seed and images only, not on the number of threads.
TrainedAutoencoder train_autoencoder(const AutoencoderSettings& settings, Seed seed, const ImageSet& train,
                                     const ImageSet& test, Workers& workers, const TrainingHooks& hooks = {});

}  // namespace hbr::inline autoencoder
