// Which samples a training goes on with.
#include <gmock/gmock.h>

#include <algorithm>
#include <numeric>

#include "tests/models/autoencoder/labelled_strokes.h"

namespace hbr {
namespace {

TEST(Cut, KeepsTheSamplesBelowTheMean) {
  const Set train(120, 1), test(40, 2);
  Workers workers(1);
  const auto before = train_autoencoder(small(2), Seed(1), train.set(), test.set(), workers);
  const auto after = train_autoencoder(small(3), Seed(1), train.set(), test.set(), workers);
  const auto images = as_floats(train.pixels);
  std::vector<float> latent(240), error(120);
  before.autoencoder.describe(120, images.data(), latent.data(), error.data());
  double mean = 0;
  for (float e : error) mean += e / 120.;
  std::array<double, 10> share{};
  std::int64_t kept = 0;
  for (std::size_t i = 0; i < 120; ++i)
    if (error[i] < mean) {
      share[i % 10] += 1 / 12.;
      ++kept;
    }
  EXPECT_EQ(after.epochs[1].samples, 120);
  EXPECT_EQ(after.epochs[2].samples, kept);
  for (std::size_t c = 0; c < 10; ++c) EXPECT_NEAR(after.kept_per_class[c], share[c], 1e-12);
  EXPECT_THAT(before.kept_per_class, testing::Each(1.));
}

// After each epoch from the second on: those of all samples whose error is below the mean.
TEST(Cut, IsMadeAgainAfterEveryEpochWhereItIsTo) {
  const Set train(120, 1), test(40, 2);
  Workers workers(1);
  const auto settings = [](int epochs) {
    AutoencoderSettings s = small(epochs);
    s.cut = "every_epoch";
    return s;
  };
  const auto after = train_autoencoder(settings(5), Seed(1), train.set(), test.set(), workers);
  const auto once = train_autoencoder(small(5), Seed(1), train.set(), test.set(), workers);
  const auto images = as_floats(train.pixels);
  EXPECT_EQ(after.epochs[1].samples, 120);
  for (const int epochs : {2, 3, 4}) {
    const auto before = train_autoencoder(settings(epochs), Seed(1), train.set(), test.set(), workers);
    std::vector<float> latent(240), error(120);
    before.autoencoder.describe(120, images.data(), latent.data(), error.data());
    const double mean = std::accumulate(error.begin(), error.end(), 0.0) / 120;
    EXPECT_EQ(after.epochs[epochs].samples, std::ranges::count_if(error, [&](float e) { return e < mean; }));
  }
  EXPECT_EQ(once.epochs[4].samples, once.epochs[2].samples);
  EXPECT_EQ(once.epochs[2].samples, after.epochs[2].samples);
}

}  // namespace
}  // namespace hbr
