#include "models/robot/body/joint_path.h"

#include <algorithm>
#include <cmath>

#include "pipeline/core/check.h"

namespace hbr::inline robots {

std::vector<double> times_at_pace(const std::vector<float>& pen, const std::vector<double>& joints,
                                  double pace, double joint_pace) {
  const std::size_t n = pen.size() / 2, dof = joints.size() / n;
  std::vector<double> times{0};
  for (std::size_t i = 1; i < n; ++i) {
    const double way = std::hypot(pen[2 * i] - pen[2 * i - 2], pen[2 * i + 1] - pen[2 * i - 1]);
    double turn = 0;
    for (std::size_t k = 0; k < dof; ++k)
      turn = std::max(turn, std::abs(joints[i * dof + k] - joints[(i - 1) * dof + k]));
    times.push_back(times.back() + std::max(way / pace, turn / joint_pace));
  }
  return times;
}

JointPath::JointPath(const std::vector<double>& joints, const std::vector<double>& times, double smoothing)
    : smoothing_(smoothing) {
  HBR_CHECK(!times.empty() && joints.size() % times.size() == 0 && smoothing > 0,
            "joints {}, times {}, smoothing {}", joints.size(), times.size(), smoothing);
  const auto dof = static_cast<Eigen::Index>(joints.size() / times.size());
  const Eigen::Map<const Eigen::MatrixXd> way(joints.data(), dof, static_cast<Eigen::Index>(times.size()));
  // Three equal points at either end let it rest there.
  const auto steps = static_cast<Eigen::Index>(std::ceil(times.back() / smoothing));
  control_.resize(dof, steps + 5);
  std::size_t before = 0;
  for (Eigen::Index i = 0; i < control_.cols(); ++i) {
    const double time = static_cast<double>(std::clamp<Eigen::Index>(i - 2, 0, steps)) * smoothing;
    while (before + 1 < times.size() && times[before + 1] <= time) ++before;
    control_.col(i) = way.col(static_cast<Eigen::Index>(before));
    if (before + 1 == times.size()) continue;
    const double share = (time - times[before]) / (times[before + 1] - times[before]);
    control_.col(i) += share * (way.col(static_cast<Eigen::Index>(before) + 1) - control_.col(i));
  }
}

JointPath::Point JointPath::at(double time) const {
  const double place = std::clamp(time / smoothing_, 0.0, static_cast<double>(control_.cols() - 3));
  const auto span = std::min(static_cast<Eigen::Index>(place), control_.cols() - 4);
  const double u = place - static_cast<double>(span), v = 1 - u, h = smoothing_;
  const auto points = control_.middleCols<4>(span);
  const Eigen::Vector4d position(v * v * v, 3 * u * u * u - 6 * u * u + 4, 3 * v * v * v - 6 * v * v + 4,
                                 u * u * u);
  const Eigen::Vector4d velocity(-v * v, 3 * u * u - 4 * u, 4 * v - 3 * v * v, u * u);
  const Eigen::Vector4d acceleration(v, 3 * u - 2, 3 * v - 2, u);
  return {points * position / 6, points * velocity / (2 * h), points * acceleration / (h * h)};
}

}  // namespace hbr::inline robots
