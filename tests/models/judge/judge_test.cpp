#include "models/judge/judge.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "models/judge/hog.h"
#include "pipeline/core/check.h"
#include "pipeline/core/random.h"

namespace hbr {
namespace {

// Ten glyphs of straight strokes, shaken: digits as on a seven-segment display.
LabelledImages glyphs(int n, std::uint64_t seed) {
  static const std::array<std::vector<float>, 10> kStrokes = {{{0, 0, 1, 0, 1, 2, 0, 2, 0, 0},
                                                               {1, 0, 1, 2},
                                                               {0, 2, 1, 2, 1, 1, 0, 1, 0, 0, 1, 0},
                                                               {0, 2, 1, 2, 1, 1, 0, 1, 1, 1, 1, 0, 0, 0},
                                                               {0, 2, 0, 1, 1, 1, 1, 2, 1, 0},
                                                               {1, 2, 0, 2, 0, 1, 1, 1, 1, 0, 0, 0},
                                                               {1, 2, 0, 2, 0, 0, 1, 0, 1, 1, 0, 1},
                                                               {0, 2, 1, 2, 1, 0},
                                                               {0, 1, 0, 2, 1, 2, 1, 0, 0, 0, 0, 1, 1, 1},
                                                               {1, 1, 0, 1, 0, 2, 1, 2, 1, 0, 0, 0}}};
  LabelledImages data;
  for (int i = 0; i < n; ++i) {
    Rng rng(Seed(seed).child(i));
    const int label = static_cast<int>(rng.below(10));
    std::vector<float> pen = kStrokes[label];
    for (float& coordinate : pen) coordinate += rng.uniform(-0.08f, 0.08f);
    std::array<float, kImagePixels> image{};
    draw(pen.data(), static_cast<Eigen::Index>(pen.size() / 2), 1.5 + rng.uniform(), Framing::box, 1,
         image.data());
    data.images.resize(data.images.size() + kImagePixels);
    image_to_bytes(image.data(), &data.images[data.images.size() - kImagePixels]);
    data.labels.push_back(static_cast<std::uint8_t>(label));
  }
  return data;
}

class JudgeTest : public ::testing::Test {
 protected:
  const JudgeSettings settings_{1000, 200, 0.2, 0.1, 5, 0.9};
  const Dataset dataset_{"glyphs", glyphs(1000, 1), glyphs(400, 2)};
  Workers workers_{2};
};

TEST_F(JudgeTest, KnowsWhatItLearnedAndRefusesWhatItDidNot) {
  const Judge judge(settings_, dataset_, workers_);
  const LabelledImages fresh = glyphs(500, 3);
  const Verdicts verdicts = judge.judge(500, fresh.images.data(), workers_);
  int right = 0, typical = 0, good = 0;
  for (int i = 0; i < 500; ++i) {
    right += verdicts.label[i] == fresh.labels[i];
    typical += verdicts.typical[i];
    good += verdicts.good[i];
    EXPECT_LE(verdicts.good[i], verdicts.typical[i]);
    EXPECT_TRUE(!verdicts.good[i] || verdicts.confidence[i] > 0);
  }
  EXPECT_GT(right, 490);
  EXPECT_NEAR(typical, 450, 25);
  EXPECT_GT(good, 400);

  std::vector<std::uint8_t> noise(100 * kImagePixels);
  Rng rng{Seed(4)};
  for (auto& pixel : noise) pixel = static_cast<std::uint8_t>(rng.below(256));
  const Verdicts none = judge.judge(100, noise.data(), workers_);
  EXPECT_EQ(std::count(none.good.begin(), none.good.end(), 1), 0);
  EXPECT_EQ(std::count(none.typical.begin(), none.typical.end(), 1), 0);
  const std::vector<std::uint8_t> black(kImagePixels);
  EXPECT_FALSE(judge.judge(1, black.data(), workers_).good[0]);
}

TEST_F(JudgeTest, WhatNoClassAcceptsIsNotGood) {
  JudgeSettings settings = settings_;
  settings.ridge = 1e6;  // shrinks every margin to -1
  const Verdicts verdicts =
      Judge(settings, dataset_, workers_).judge(400, dataset_.test.images.data(), workers_);
  EXPECT_GT(std::count(verdicts.typical.begin(), verdicts.typical.end(), 1), 300);
  EXPECT_EQ(std::count(verdicts.good.begin(), verdicts.good.end(), 1), 0);
}

TEST_F(JudgeTest, WhatItsNeighboursDisputeIsNotGood) {
  JudgeSettings settings = settings_;
  settings.neighbours = 1000;  // all of them: a tenth agrees
  const Verdicts verdicts =
      Judge(settings, dataset_, workers_).judge(400, dataset_.test.images.data(), workers_);
  EXPECT_GT((verdicts.confidence.array() > 0).count(), 300);
  EXPECT_EQ(std::count(verdicts.good.begin(), verdicts.good.end(), 1), 0);
}

TEST_F(JudgeTest, ATrainingImageIsAtNoDistance) {
  const Judge judge(settings_, dataset_, workers_);
  const Verdicts verdicts = judge.judge(50, dataset_.train.images.data(), workers_);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(verdicts.distance[i], 0);
}

TEST_F(JudgeTest, SurvivesItsFile) {
  const auto path =
      std::filesystem::temp_directory_path() / ("hbr_judge_" + std::to_string(getpid()) + ".h5");
  const Judge judge(settings_, dataset_, workers_);
  {
    Hdf5Writer file(path);
    judge.save(file);
    file.close();
  }
  Workers one(1);
  const Judge again(Hdf5Reader(path), dataset_, one);
  std::filesystem::remove(path);
  const Verdicts a = judge.judge(400, dataset_.test.images.data(), workers_);
  const Verdicts b = again.judge(400, dataset_.test.images.data(), one);
  EXPECT_EQ(a.label, b.label);
  EXPECT_EQ(a.confidence, b.confidence);
  EXPECT_EQ(a.distance, b.distance);
  EXPECT_EQ(a.good, b.good);
}

TEST_F(JudgeTest, JudgesNothing) {
  const Judge judge(settings_, dataset_, workers_);
  EXPECT_TRUE(judge.judge(0, nullptr, workers_).label.empty());
}

TEST_F(JudgeTest, RefusesSettingsThatDoNotFit) {
  JudgeSettings settings = settings_;
  settings.training_images = 1001;
  EXPECT_THROW(Judge(settings, dataset_, workers_), InputError);
  settings = settings_;
  settings.bumps = 1001;
  EXPECT_THROW(Judge(settings, dataset_, workers_), InputError);
}

TEST(LostDigits, WereGoodAndAreNotOrAreOthers) {
  Verdicts before, after;
  before.label = {3, 3, 3, 3, 7};
  before.good = {1, 1, 1, 0, 0};
  after.label = {3, 3, 5, 5, 7};
  after.good = {1, 0, 1, 0, 1};
  EXPECT_EQ(lost_digits(before, after), (std::vector<std::uint8_t>{0, 1, 1, 0, 0}));
}

// A grey edge has its gradients in one direction, at right angles to it; turned by half a turn, in the
// opposite one.
TEST(Hog, SeesTheDirectionOfAnEdge) {
  std::vector<std::uint8_t> images(2 * kImagePixels);
  for (int i = 0; i < kImagePixels; ++i) {
    images[i] = i % 28 < 14 ? 0 : 200;
    images[kImagePixels + i] = i % 28 < 14 ? 200 : 0;
  }
  Workers workers(1);
  const Rows features = hog_features(2, images.data(), workers);
  const auto by_direction = [&](int image) {
    Eigen::VectorXf sum = Eigen::VectorXf::Zero(9);
    for (int i = 0; i < kHogSize; ++i) sum[i % 9] += features(image, i);
    return sum;
  };
  const Eigen::VectorXf right = by_direction(0), left = by_direction(1);
  Eigen::Index at_right = 0, at_left = 0;
  right.maxCoeff(&at_right);
  left.maxCoeff(&at_left);
  EXPECT_NE(at_right, at_left);
  EXPECT_LT((right.array() > 0).count(), 3);
  EXPECT_LT((left.array() > 0).count(), 3);
}

}  // namespace
}  // namespace hbr
