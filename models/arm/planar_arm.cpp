#include "models/arm/planar_arm.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>
#include <numbers>

namespace hbr::inline arm {
namespace {

// Configurations in step: loops over the lanes become vectors. A lane never sees another one and no operation
// is reordered, so that a pen has the same bits on every machine and in every batch.
constexpr int kArms = 8;

// sin(pi r) / r and cos(pi r) as polynomials in r^2 for |r| <= 1/2: interpolation at the Chebyshev nodes,
// errors below 4e-16.
constexpr double kSine[] = {3.1415926535897927,    -5.1677127800497855,   2.5501640398618677,
                            -0.599264528825224,    0.08214587881631043,   -0.0073703643265304155,
                            0.0004659870158043378, -2.113362735205297e-05};
constexpr double kCosine[] = {1,
                              -4.934802200544679,
                              4.058712126416736,
                              -1.3352627688518803,
                              0.2353306302721577,
                              -0.02580689002587539,
                              0.001929562652479866,
                              -0.00010458286368326585,
                              4.166399462726949e-06};

template <std::size_t N>
double polynomial(const double (&coefficients)[N], double z) {
  double sum = coefficients[N - 1];
  for (std::size_t i = N - 1; i-- > 0;) sum = sum * z + coefficients[i];
  return sum;
}

// The tips of kArms arms. The direction of a link is kept as half turns in [-1/2, 1/2] and the parity of the
// half turns taken away: rounding errors do not grow with the number of turns, and both polynomials are
// short.
struct Tips {
  alignas(64) double x[kArms] = {}, y[kArms] = {};

  Tips(const std::vector<double>& links, const double* const (&joints)[kArms]) {
    constexpr double kRound = 0x1.8p52;  // added, it leaves a number's nearest integer in the lowest bits
    alignas(64) double direction[kArms] = {}, joint[kArms];
    alignas(64) std::uint64_t parity[kArms] = {};
    for (std::size_t j = 0; j < links.size(); ++j) {
      const double link = links[j];
      for (int l = 0; l < kArms; ++l) joint[l] = joints[l][j];
      for (int l = 0; l < kArms; ++l) {
        const double half_turns = direction[l] + joint[l] * std::numbers::inv_pi;
        const double shifted = half_turns + kRound;
        const double r = half_turns - (shifted - kRound);
        direction[l] = r;
        parity[l] ^= std::bit_cast<std::uint64_t>(shifted);
        const auto signed_link =
            std::bit_cast<double>(std::bit_cast<std::uint64_t>(link) ^ (parity[l] << 63));
        x[l] += signed_link * polynomial(kCosine, r * r);
        y[l] += signed_link * (r * polynomial(kSine, r * r));
      }
    }
  }
};

}  // namespace

PlanarArm::PlanarArm(const std::vector<double>& links, double limit)
    : links_(links),
      lower_(Eigen::VectorXd::Constant(static_cast<Eigen::Index>(links.size()), -limit)),
      upper_(-lower_) {}

void PlanarArm::pens(Eigen::Index n, const double* joints, Pen* pens) const {
  for (Eigen::Index begin = 0; begin < n; begin += kArms) {
    // The last lanes may be copies of the last configuration.
    const double* configuration[kArms];
    for (int l = 0; l < kArms; ++l) configuration[l] = joints + std::min(begin + l, n - 1) * dof();
    const Tips tips(links_, configuration);
    const Eigen::Index end = std::min(begin + kArms, n);
    for (Eigen::Index i = begin; i < end; ++i) pens[i] = {{tips.x[i - begin], tips.y[i - begin]}, 0};
  }
}

}  // namespace hbr::inline arm
