#include "models/judge/rbf_classifier.h"

#include <gmock/gmock.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"

namespace hbr {
namespace {

struct Cloud {
  Rows features;
  std::vector<std::uint8_t> labels;
};

// Three classes: rings around the origin, which no straight line parts.
Cloud rings(int n, std::uint64_t seed) {
  Rng rng{Seed(seed)};
  Cloud cloud{Rows(n, 2), {}};
  for (int i = 0; i < n; ++i) {
    const int label = static_cast<int>(rng.below(3));
    const float radius = static_cast<float>(label) + rng.uniform(0.8f, 1.2f),
                angle = rng.uniform(0, 6.2831853f);
    cloud.features.row(i) << radius * std::cos(angle), radius * std::sin(angle);
    cloud.labels.push_back(static_cast<std::uint8_t>(label));
  }
  return cloud;
}

TEST(RbfClassifier, SolvesItsRidgeProblem) {
  const Cloud cloud = rings(600, 1);
  const double gamma = 1.5, ridge = 0.3;
  const RbfClassifier fitted = fit_rbf_classifier(cloud.features, cloud.labels, 3, 40, gamma, ridge);
  // The same as an ordinary least-squares problem with rows for the penalty, by QR in double.
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(640, 40), target = Eigen::MatrixXd::Zero(640, 3);
  for (int i = 0; i < 600; ++i) {
    for (int b = 0; b < 40; ++b)
      system(i, b) = std::exp(
          -gamma * (cloud.features.row(i) - cloud.features.row(b * 600 / 40)).cast<double>().squaredNorm());
    target(i, cloud.labels[i]) = 1;
  }
  for (int b = 0; b < 40; ++b) system(600 + b, b) = std::sqrt(ridge);
  const Eigen::MatrixXd weights = system.householderQr().solve(target);
  EXPECT_LT((weights - fitted.weights.cast<double>()).cwiseAbs().maxCoeff(), 1e-3);
}

// As many rows as the dataset has: the sums over them keep what the ridge is about.
TEST(RbfClassifier, SumsManyRowsAsWellAsFew) {
  constexpr int kRows = 60000, kBumps = 60;
  const Cloud cloud = rings(kRows, 1);
  const double gamma = 0.05, ridge = 0.1;
  const RbfClassifier fitted = fit_rbf_classifier(cloud.features, cloud.labels, 3, kBumps, gamma, ridge);
  Eigen::MatrixXd values(kRows, kBumps), target = Eigen::MatrixXd::Zero(kRows, 3);
  for (int i = 0; i < kRows; ++i) {
    for (int b = 0; b < kBumps; ++b)
      values(i, b) = std::exp(
          -gamma *
          (cloud.features.row(i) - cloud.features.row(b * kRows / kBumps)).cast<double>().squaredNorm());
    target(i, cloud.labels[i]) = 1;
  }
  Eigen::MatrixXd system = values.transpose() * values;
  system.diagonal().array() += ridge;
  const Eigen::MatrixXd weights = system.ldlt().solve(values.transpose() * target);
  const Eigen::MatrixXd difference = values * (weights - fitted.weights.cast<double>());
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 0.01);  // 0.13 where all sums are single
}

// Bumps that are all alike: what single precision loses is more than the ridge.
TEST(RbfClassifier, RefusesARidgeThatItsPrecisionSwallows) {
  const Cloud cloud = rings(3000, 1);
  EXPECT_THAT([&] { fit_rbf_classifier(cloud.features, cloud.labels, 3, 600, 1e-6, 1e-9); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("expected a larger ridge or gamma")));
}

TEST(RbfClassifier, TellsRingsApartAndRefusesWhatIsFar) {
  const Cloud train = rings(600, 1), test = rings(900, 2);
  const RbfClassifier fitted = fit_rbf_classifier(train.features, train.labels, 3, 100, 4, 0.01);
  Workers workers(2);
  const Rows margins = fitted.margins(test.features, workers);
  int right = 0;
  for (int i = 0; i < 900; ++i) {
    Eigen::Index label = 0;
    margins.row(i).maxCoeff(&label);
    right += label == test.labels[i];
  }
  EXPECT_GT(right, 880);
  EXPECT_LT(fitted.margins(Rows::Constant(1, 2, 50), workers).maxCoeff(), -0.99);
}

TEST(RbfClassifier, DoesNotDependOnThreads) {
  const Cloud train = rings(600, 1), test = rings(2000, 2);
  const RbfClassifier fitted = fit_rbf_classifier(train.features, train.labels, 3, 100, 4, 0.01);
  Workers one(1), two(2);
  EXPECT_EQ(fitted.margins(test.features, one), fitted.margins(test.features, two));
}

}  // namespace
}  // namespace hbr
