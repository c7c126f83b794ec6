// The layers without anything that makes them fast: one thing after the other, every elite asked for its
// distance, doubles where the text has real numbers. The tests' second opinion and the benchmarks' reference.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/hierarchy/layers/arcs.h"
#include "pipeline/hierarchy/layers/lines.h"
#include "pipeline/hierarchy/point_layer.h"

namespace hbr {

class NaiveArm final : public Robot {
 public:
  NaiveArm(const std::vector<double>& links, double limit)
      : links_(links),
        lower_(Eigen::VectorXd::Constant(static_cast<Eigen::Index>(links.size()), -limit)),
        upper_(-lower_) {}
  std::string name() const override { return "naive arm"; }
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  void pens(Eigen::Index n, const double* joints, Pen* pens) const override {
    for (Eigen::Index i = 0; i < n; ++i) {
      double angle = 0, x = 0, y = 0;
      for (const double link : links_) {
        angle += *joints++;
        x += link * std::cos(angle);
        y += link * std::sin(angle);
      }
      pens[i] = {{x, y}, 0};
    }
  }

 private:
  std::vector<double> links_;
  Eigen::VectorXd lower_, upper_;
};

// The lowest of the rows nearest to a query.
inline std::int32_t naive_nearest(const Rows& rows, const float* query) {
  std::int32_t best = 0;
  float least = std::numeric_limits<float>::infinity();
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    float squared = 0;
    for (Eigen::Index d = 0; d < rows.cols(); ++d)
      squared += (rows(i, d) - query[d]) * (rows(i, d) - query[d]);
    if (squared < least) {
      least = squared;
      best = static_cast<std::int32_t>(i);
    }
  }
  return best;
}

template <int D>
struct NaiveMedian {
  Eigen::Matrix<double, D, 1> point;
  double mean_distance;
  std::size_t nearest;
};

// Weiszfeld (1937) as in textbooks, until it moves by less than 1e-6.
template <int D>
NaiveMedian<D> naive_median(const std::vector<Eigen::Matrix<double, D, 1>>& samples) {
  using Vector = Eigen::Matrix<double, D, 1>;
  Vector median = Vector::Zero();
  for (const Vector& s : samples) median += s / static_cast<double>(samples.size());
  for (int step = 0; step < 1000; ++step) {
    Vector sum = Vector::Zero();
    double weights = 0;
    for (const Vector& s : samples) {
      const double weight = 1 / std::max((s - median).norm(), 1e-12);
      sum += weight * s;
      weights += weight;
    }
    const Vector next = sum / weights;
    const double moved = (next - median).norm();
    median = next;
    if (moved < 1e-6) break;
  }
  NaiveMedian<D> found{median, 0, 0};
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double distance = (samples[i] - median).norm();
    found.mean_distance += distance / static_cast<double>(samples.size());
    if (distance < (samples[found.nearest] - median).norm()) found.nearest = i;
  }
  return found;
}

// Layers 1 and 2 without a table.
class NaiveHierarchy {
 public:
  NaiveHierarchy(const Elites& points, const Elites& lines, const Robot& robot, const Frame& frame)
      : points_(points), lines_(lines), robot_(robot), frame_(frame) {}

  const Frame& frame() const { return frame_; }
  std::int32_t random_start(Rng& rng) const {
    return static_cast<std::int32_t>(rng.below(static_cast<std::uint32_t>(points_.size())));
  }
  Eigen::Vector2d pen(std::int32_t elite) const {
    return frame_.point(points_.measures.row(elite).transpose().cast<double>());
  }
  double variance(std::int32_t elite) const {
    std::vector<double> joints(robot_.dof());
    decode_joints(robot_, points_.solution.row(elite).data(), joints.data());
    return joint_variance(joints.data(), robot_.dof());
  }
  std::int32_t line_end(std::int32_t start, const Eigen::Vector2d& displacement) const {
    const Eigen::Vector2f query = frame_.point_descriptor(pen(start) + displacement).cast<float>();
    return naive_nearest(points_.measures, query.data());
  }
  Eigen::Vector2d request(const Eigen::Vector2d& wanted) const {
    const Eigen::Vector2f query = frame_.line_descriptor(wanted).cast<float>();
    return decode_line(frame_, lines_.solution.row(naive_nearest(lines_.measures, query.data())).data());
  }

 private:
  const Elites &points_, &lines_;
  const Robot& robot_;
  Frame frame_;
};

class NaiveLineEvaluator final : public Evaluator {
 public:
  NaiveLineEvaluator(const NaiveHierarchy& hierarchy, int samples)
      : hierarchy_(hierarchy), samples_(samples) {}
  int descriptor_size() const override { return 2; }
  bool stochastic() const override { return true; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override {
    for (Eigen::Index i = begin; i < end; ++i) {
      Rng rng(seed.child(i));
      const Eigen::Vector2d displacement = decode_line(hierarchy_.frame(), batch.genome.row(i).data());
      std::vector<Eigen::Vector2d> drawn;
      for (int s = 0; s < samples_; ++s) {
        const std::int32_t start = hierarchy_.random_start(rng);
        const Eigen::Vector2d stop = hierarchy_.pen(hierarchy_.line_end(start, displacement));
        drawn.push_back(hierarchy_.frame().line_descriptor(stop - hierarchy_.pen(start)));
      }
      const NaiveMedian<2> median = naive_median<2>(drawn);
      batch.descriptor.row(i) = median.point.transpose().cast<float>();
      batch.uncertainty[i] = static_cast<float>(median.mean_distance);
      batch.fitness[i] = 0;
      batch.valid[i] = 1;
    }
  }

 private:
  const NaiveHierarchy& hierarchy_;
  int samples_;
};

class NaiveArcEvaluator final : public Evaluator {
 public:
  NaiveArcEvaluator(const NaiveHierarchy& hierarchy, const ArcController& controller, int samples)
      : hierarchy_(hierarchy), controller_(controller), samples_(samples) {}
  int descriptor_size() const override { return 3; }
  bool stochastic() const override { return true; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override {
    for (Eigen::Index i = begin; i < end; ++i) {
      Rng rng(seed.child(i));
      std::vector<Eigen::Vector3d> descriptors;
      std::vector<double> fitness;
      for (int s = 0; s < samples_; ++s) {
        std::int32_t at = hierarchy_.random_start(rng);
        ArcPoints drawn{hierarchy_.pen(at)};
        double variance = 0;
        for (int k = 0; k < kArcSegments; ++k) {
          const ArcLines wanted = controller_.decode(hierarchy_.frame(), batch.genome.row(i).data());
          at = hierarchy_.line_end(at, hierarchy_.request(wanted[k]));
          drawn[k + 1] = hierarchy_.pen(at);
          variance += hierarchy_.variance(at) / kArcSegments;
        }
        descriptors.push_back(arc_descriptor(hierarchy_.frame(), arc_shape(drawn)));
        fitness.push_back(-(irregularity(drawn) + variance));
      }
      const NaiveMedian<3> median = naive_median<3>(descriptors);
      batch.descriptor.row(i) = median.point.transpose().cast<float>();
      batch.uncertainty[i] = static_cast<float>(median.mean_distance);
      batch.fitness[i] = static_cast<float>(fitness[median.nearest]);
      batch.valid[i] = 1;
    }
  }

 private:
  const NaiveHierarchy& hierarchy_;
  ArcController controller_;
  int samples_;
};

}  // namespace hbr
