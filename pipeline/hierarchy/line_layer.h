// Layer 2, lines: a displacement asked of the pen, executed through layer 1.
#pragma once

#include <array>
#include <vector>

#include "pipeline/hierarchy/point_layer.h"

namespace hbr {

// Two genes in [0, 1] -> a displacement [m] within the square of side 2 rho; in the disc of radius rho its
// corners are brought back along their direction.
Eigen::Vector2d decode_line(const Frame& frame, const float* genes);

// Where a line that asks for `displacement` [m] from the elite `start` ends: the elite nearest to start +
// displacement.
std::int32_t line_end(const PointLayer& points, std::int32_t start, const Eigen::Vector2d& displacement);

// The same for n executions at once: each from its own start by its own step, in layer 1's descriptor units
// (Frame::point_step).
void line_ends(const PointLayer& points, int n, const std::int32_t* starts, const float* step_x,
               const float* step_y, std::int32_t* ends);

// The elites visited on the way: those nearest to points `spacing` [m] apart along the segment, repeats left
// out, the start excluded, the end included.
void line_path(const PointLayer& points, std::int32_t start, const Eigen::Vector2d& displacement,
               double spacing, std::vector<std::int32_t>& path);

// The finished layer.
class LineLayer {
 public:
  LineLayer(const Elites& elites, const Frame& frame);
  Eigen::Index size() const { return table_.size(); }
  // What the controller nearest to a wanted displacement [m] asks of layer 1 [m].
  Eigen::Vector2d request(const Eigen::Vector2d& wanted) const {
    const Eigen::Vector2f descriptor = frame_.line_descriptor(wanted).cast<float>();
    return requests_[table_.nearest(descriptor.data())];
  }

  // The same for n displacements at once, given as layer 2's descriptors, a coordinate after the other; what
  // is asked of layer 1 comes in its descriptor units.
  void requests(int n, const std::array<const float*, 2>& wanted, float* step_x, float* step_y) const;

 private:
  Frame frame_;
  NearestTable<2> table_;
  std::vector<Eigen::Vector2d> requests_;
};

// Genome [2] -> stochastic descriptor of V / 2 rho + 1/2: the geometric median over `samples` starts drawn
// uniformly among layer-1 elites (paper, section 3.1). Fitness 0.
class LineEvaluator final : public Evaluator {
 public:
  LineEvaluator(const PointLayer& points, const Frame& frame, int samples);
  int descriptor_size() const override { return 2; }
  bool stochastic() const override { return true; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override;

 private:
  const PointLayer& points_;
  Frame frame_;
  int samples_;
};

// The reference without a stochastic descriptor (paper, section 5.3): genome [2] -> (P0, V), one execution
// from a random start, P0 as in layer 1, V as in layer 2. Fitness 0.
class LineFromStartEvaluator final : public Evaluator {
 public:
  LineFromStartEvaluator(const PointLayer& points, const Frame& frame);
  int descriptor_size() const override { return 4; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override;

 private:
  const PointLayer& points_;
  Frame frame_;
};

}  // namespace hbr
