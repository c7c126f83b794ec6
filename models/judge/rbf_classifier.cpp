#include "models/judge/rbf_classifier.h"

#include <Eigen/Cholesky>
#include <algorithm>

#include "pipeline/core/check.h"

namespace hbr::inline judge {
namespace {

constexpr Eigen::Index kBlock = 512;  // rows at a time; fixed, as it decides how sums are rounded

std::size_t blocks(Eigen::Index rows) { return (rows + kBlock - 1) / kBlock; }

// The bumps' values [n x bumps] at features [n x d].
template <class Features>
Rows bump_values(const Features& features, const Rows& centres, double gamma) {
  const auto g = static_cast<float>(gamma);
  Rows values = (2 * g) * (features * centres.transpose());
  values.colwise() -= g * features.rowwise().squaredNorm();
  values.rowwise() -= g * centres.rowwise().squaredNorm().transpose();
  return values.array().min(0.0f).exp();
}

}  // namespace

Rows RbfClassifier::margins(const Rows& features, Workers& workers) const {
  Rows result(features.rows(), weights.cols());
  workers.for_each(blocks(features.rows()), [&](std::size_t block) {
    const Eigen::Index begin = block * kBlock, count = std::min(kBlock, features.rows() - begin);
    const Rows indicator = bump_values(features.middleRows(begin, count), centres, gamma) * weights;
    result.middleRows(begin, count) = 2 * indicator.array() - 1;
  });
  return result;
}

RbfClassifier fit_rbf_classifier(const Rows& features, const std::vector<std::uint8_t>& labels, int classes,
                                 int bumps, double gamma, double ridge) {
  const Eigen::Index n = features.rows();
  HBR_CHECK(bumps >= 1 && bumps <= n && ridge > 0, "{} bumps, {} rows, ridge {}", bumps, n, ridge);
  RbfClassifier classifier;
  classifier.gamma = gamma;
  classifier.centres.resize(bumps, features.cols());
  for (Eigen::Index i = 0; i < bumps; ++i) classifier.centres.row(i) = features.row(i * n / bumps);

  // Normal equations, a block of rows at a time: the bumps of all rows would be a gigabyte. The products of a
  // block are single, their sum is double: what a single sum over 60 000 rows loses is more than the ridge.
  Eigen::MatrixXd system = Eigen::MatrixXd::Zero(bumps, bumps);
  Eigen::MatrixXf products(bumps, bumps);
  Eigen::MatrixXf targets = Eigen::MatrixXf::Zero(bumps, classes);
  for (std::size_t block = 0; block < blocks(n); ++block) {
    const Eigen::Index begin = block * kBlock, count = std::min(kBlock, n - begin);
    const Rows values = bump_values(features.middleRows(begin, count), classifier.centres, gamma);
    products.setZero();
    products.selfadjointView<Eigen::Lower>().rankUpdate(values.transpose());
    system.triangularView<Eigen::Lower>() += products.cast<double>();
    for (Eigen::Index i = 0; i < count; ++i) targets.col(labels[begin + i]) += values.row(i).transpose();
  }
  system.diagonal().array() += ridge;
  const Eigen::LLT<Eigen::MatrixXd> factor(system);
  if (factor.info() != Eigen::Success)
    throw InputError(
        "judge: ridge {} is too small for {} bumps of gamma {} in single precision; expected a larger ridge "
        "or gamma",
        ridge, bumps, gamma);
  classifier.weights = factor.solve(targets.cast<double>()).cast<float>();
  return classifier;
}

}  // namespace hbr::inline judge
