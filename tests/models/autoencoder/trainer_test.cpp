// Training: same bytes for any number of threads and after an interruption, collapse.
#include "models/autoencoder/trainer.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "models/autoencoder/adam.h"
#include "models/autoencoder/collapse.h"
#include "models/autoencoder/gradient.h"
#include "pipeline/core/check.h"
#include "tests/models/autoencoder/labelled_strokes.h"

namespace hbr {
namespace {

using testing::HasSubstr;

std::string failure(const AutoencoderSettings& settings, const ImageSet& train, const ImageSet& test,
                    const TrainingHooks& hooks = {}) {
  Workers workers(1);
  try {
    train_autoencoder(settings, Seed(1), train, test, workers, hooks);
    return "trained";
  } catch (const InputError& e) {
    return e.what();
  }
}

TEST(Trainer, LearnsAFewImages) {
  Set train(160, 1);
  for (std::size_t i = 4 * 784; i < train.pixels.size(); ++i) train.pixels[i] = train.pixels[i % (4 * 784)];
  AutoencoderSettings settings = small(20);
  settings.batch = 16;
  settings.halve_every = 100;
  settings.cut_after = 0;
  Workers workers(1);
  const auto trained = train_autoencoder(settings, Seed(1), train.set(), train.set(), workers);
  ASSERT_EQ(trained.epochs.size(), 20u);
  EXPECT_LT(trained.epochs.back().train_error, 0.3 * trained.epochs.front().train_error);
  EXPECT_LT(*trained.epochs.back().test_error, 0.3 * *trained.epochs.front().test_error);
  EXPECT_THAT(trained.kept_per_class, testing::Each(1.));
}

// Adam's first step is the rate against the sign of every gradient, whatever its size.
TEST(Trainer, TheFirstStepGoesDownEveryGradient) {
  const Set train(30, 1), test(10, 2);
  AutoencoderSettings settings = small(1);
  Workers workers(1);
  std::vector<net::Floats> found;
  for (const int batch : {30, 40}) {  // a batch is no larger than the set
    settings.batch = batch;
    const auto trained = train_autoencoder(settings, Seed(1), train.set(), test.set(), workers);
    found.push_back(trained.autoencoder.network().parameters);
  }
  EXPECT_EQ(found[0], found[1]);

  net::Network network(settings.latent_size, activations_of(settings));
  network.initialise(Seed(1), static_cast<float>(settings.output_bias));
  std::vector<const std::uint8_t*> rows;
  for (std::size_t i = 0; i < 30; ++i) rows.push_back(train.pixels.data() + i * 784);
  net::BatchGradient gradient(network.layout);
  gradient.find(network, 30, rows.data(), 1.f / 30, workers);
  for (const net::Layer& l : network.layout.layers)
    for (net::Index k = 0; k < l.inputs * l.stride; ++k) {
      const auto i = static_cast<std::size_t>(l.kernel + k);
      const float g = gradient.gradient()[i];
      if (std::abs(g) < 1e-6f) continue;
      ASSERT_NEAR(found[0][i] - network.parameters[i], g > 0 ? -1e-3 : 1e-3, 2e-5) << l.name;
    }
}

TEST(Trainer, TheRateIsHalvedAfterItsEpochs) {
  const Set train(60, 1), test(10, 2);
  Workers workers(1);
  const auto trained = [&](int epochs, int halve_every) {
    AutoencoderSettings settings = small(epochs);
    settings.halve_every = halve_every;
    return train_autoencoder(settings, Seed(1), train.set(), test.set(), workers)
        .autoencoder.network()
        .parameters;
  };
  EXPECT_EQ(trained(1, 1), trained(1, 9));
  EXPECT_NE(trained(2, 1), trained(2, 9));
  EXPECT_EQ(trained(2, 2), trained(2, 9));
}

TEST(Trainer, TestsTheFirstTheLastAndSomeEpochs) {
  const Set train(60, 1), test(10, 2);
  Workers workers(1);
  const auto trained = [&](int test_every) {
    AutoencoderSettings settings = small(5);
    settings.test_every = test_every;
    return train_autoencoder(settings, Seed(1), train.set(), test.set(), workers);
  };
  const auto all = trained(1), some = trained(3);
  for (std::size_t e = 0; e < 5; ++e) {
    ASSERT_TRUE(all.epochs[e].test_error);
    if (e == 0 || e == 2 || e == 4)
      EXPECT_EQ(some.epochs[e].test_error, all.epochs[e].test_error);
    else
      EXPECT_FALSE(some.epochs[e].test_error);
  }
  EXPECT_EQ(some.autoencoder.network().parameters, all.autoencoder.network().parameters);
}

// In the order of the set, two neighbours would share every batch and changing their places would change
// little but rounding.
TEST(Trainer, BatchesAreShuffled) {
  const Set train(60, 1), test(10, 2);
  Set swapped = train;
  std::swap_ranges(swapped.pixels.begin(), swapped.pixels.begin() + 784, swapped.pixels.begin() + 784);
  AutoencoderSettings settings = small(1);
  settings.batch = 10;
  Workers workers(1);
  const auto a = train_autoencoder(settings, Seed(1), train.set(), test.set(), workers);
  const auto b = train_autoencoder(settings, Seed(1), swapped.set(), test.set(), workers);
  EXPECT_GT(std::abs(a.epochs[0].train_error / b.epochs[0].train_error - 1), 1e-4);
}

TEST(Trainer, ThreadsLeaveNoTrace) {
  const Set train(130, 1), test(40, 2);
  const auto trained = [&](std::uint64_t seed, int threads) {
    Workers workers(threads);  // the fewest alive count for all
    return train_autoencoder(small(3), Seed(seed), train.set(), test.set(), workers);
  };
  const auto a = trained(1, 1), b = trained(1, 3);
  EXPECT_EQ(a.autoencoder.network().parameters, b.autoencoder.network().parameters);
  for (std::size_t e = 0; e < 3; ++e) {
    EXPECT_EQ(a.epochs[e].train_error, b.epochs[e].train_error);
    EXPECT_EQ(a.epochs[e].test_error, b.epochs[e].test_error);
  }
  EXPECT_NE(a.autoencoder.network().parameters, trained(2, 1).autoencoder.network().parameters);
}

TEST(Trainer, GoesOnFromACheckpointToTheSameBytes) {
  const Set train(100, 1), test(40, 2);
  Workers workers(1);
  AutoencoderSettings five = small(5);
  five.test_every = 2;
  TrainingHooks hooks;
  hooks.checkpoint = std::filesystem::path(testing::TempDir()) / "autoencoder_checkpoint.h5";
  std::filesystem::remove(hooks.checkpoint);
  const auto whole = train_autoencoder(five, Seed(1), train.set(), test.set(), workers);

  struct Killed {};
  for (int killed_after : {1, 3}) {
    hooks.on_epoch = [&](const EpochReport& e) {
      if (e.epoch == killed_after) throw Killed();
    };
    EXPECT_THROW(train_autoencoder(five, Seed(1), train.set(), test.set(), workers, hooks), Killed);
  }
  std::vector<int> epochs;
  std::vector<std::string> messages;
  hooks.on_epoch = [&](const EpochReport& e) { epochs.push_back(e.epoch); };
  hooks.on_message = [&](const std::string& line) { messages.push_back(line); };
  const auto resumed = train_autoencoder(five, Seed(1), train.set(), test.set(), workers, hooks);
  EXPECT_THAT(epochs, testing::ElementsAre(4, 5));
  EXPECT_THAT(messages, testing::IsEmpty());
  EXPECT_EQ(resumed.autoencoder.network().parameters, whole.autoencoder.network().parameters);
  EXPECT_EQ(resumed.kept_per_class, whole.kept_per_class);
  for (std::size_t e = 0; e < 5; ++e) {
    EXPECT_EQ(resumed.epochs[e].samples, whole.epochs[e].samples);
    EXPECT_EQ(resumed.epochs[e].train_error, whole.epochs[e].train_error);
    EXPECT_EQ(resumed.epochs[e].test_error, whole.epochs[e].test_error);
  }

  // Another seed's, and a damaged one.
  train_autoencoder(small(1), Seed(2), train.set(), test.set(), workers, hooks);
  ASSERT_THAT(messages, testing::SizeIs(1));
  EXPECT_THAT(messages[0], HasSubstr("belongs to another training"));
  {
    std::fstream file(hooks.checkpoint, std::ios::in | std::ios::out | std::ios::binary);
    file.seekp(200000);
    for (int i = 0; i < 100; ++i) file.put('x');
  }
  epochs.clear();
  train_autoencoder(small(1), Seed(2), train.set(), test.set(), workers, hooks);
  EXPECT_THAT(messages, testing::SizeIs(2));
  EXPECT_THAT(epochs, testing::ElementsAre(1));
  std::filesystem::resize_file(hooks.checkpoint, 1000);
  train_autoencoder(small(1), Seed(2), train.set(), test.set(), workers, hooks);
  EXPECT_THAT(messages, testing::SizeIs(3));
}

TEST(Trainer, UsesTheFirstSamplesOnly) {
  Set train(100, 1);
  const Set test(40, 2);
  AutoencoderSettings settings = small(2);
  settings.training_samples = 60;
  Workers workers(1);
  const auto a = train_autoencoder(settings, Seed(1), train.set(), test.set(), workers);
  EXPECT_EQ(a.epochs[0].samples, 60);
  train.pixels[61 * 784 + 300] ^= 255;
  const auto b = train_autoencoder(settings, Seed(1), train.set(), test.set(), workers);
  EXPECT_EQ(a.autoencoder.network().parameters, b.autoencoder.network().parameters);
  settings.training_samples = 101;
  EXPECT_THAT(failure(settings, train.set(), test.set()), HasSubstr("there are only 100 training images"));
}

TEST(Trainer, RefusesWhatCannotBeLearned) {
  const Set train(100, 1), test(40, 2);
  AutoencoderSettings settings = small(30);
  settings.learning_rate = 1;
  EXPECT_THAT(failure(settings, train.set(), test.set()),
              testing::AnyOf(HasSubstr("collapsed"), HasSubstr("diverged")));
  const Set few(8, 1), fewer(2, 2);
  settings = small(1001);
  settings.batch = 8;
  settings.learning_rate = 1e-8;
  EXPECT_THAT(failure(settings, few.set(), fewer.set()),
              HasSubstr("epoch 1000: the autoencoder collapsed: its error"));
  Set labels(100, 1);
  labels.labels[7] = 10;
  EXPECT_THAT(failure(small(1), labels.set(), test.set()),
              HasSubstr("training image 7: label 10, expected 0 to 9"));
  EXPECT_THAT(failure(small(1), train.set(), ImageSet{}), HasSubstr("no test images"));
}

TEST(Collapse, IsTold) {
  std::vector<float> latent(100, 0.999f);
  std::fill_n(latent.begin(), 9, -0.5f);
  EXPECT_THROW(net::refuse_collapse(latent, 0.03, 0.07, true, "seed 1, epoch 2"), InputError);
  latent[9] = latent[10] = 0.2f;
  net::refuse_collapse(latent, 0.03, 0.07, true, "");
  net::refuse_collapse(latent, 0.07, 0.07, false, "");
  try {
    net::refuse_collapse(latent, 0.07, 0.07, true, "seed 1, epoch 2");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(),
                testing::AllOf(HasSubstr("seed 1, epoch 2"), HasSubstr("0.0700"), HasSubstr("output_bias")));
  }
}

TEST(Adam, FollowsItsDefinition) {
  net::Adam adam(3);
  Workers workers(1);
  net::Floats parameters{1, -2, 3};
  std::vector<double> expected{1, -2, 3}, m(3), s(3);
  Rng rng{Seed(6)};
  for (int t = 1; t <= 50; ++t) {
    float gradient[3];
    for (std::size_t i = 0; i < 3; ++i) {
      gradient[i] = rng.uniform(-1, 2);
      m[i] = 0.9 * m[i] + 0.1 * gradient[i];
      s[i] = 0.999 * s[i] + 0.001 * gradient[i] * gradient[i];
      expected[i] -=
          0.01 * (m[i] / (1 - std::pow(0.9, t))) / (std::sqrt(s[i] / (1 - std::pow(0.999, t))) + 1e-8);
    }
    adam.step(0.01, gradient, parameters, workers);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(parameters[i], expected[i], 1e-5);
  }
}

}  // namespace
}  // namespace hbr
