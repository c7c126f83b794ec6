// Layer 4, digits: a start and one to three arcs, drawn as an image and judged by a learned descriptor.
#pragma once

#include <vector>

#include "pipeline/drawing/draw.h"
#include "pipeline/hierarchy/arc_layer.h"
#include "pipeline/hierarchy/descriptor.h"

namespace hbr {

// How a trace becomes an image.
struct Pencil {
  Framing framing;
  double thinnest_px;  // pen width that gene 0 means, pixels of the image
  double thickest_px;  // pen width that gene 1 means
  double width(float gene) const { return thinnest_px + gene * (thickest_px - thinnest_px); }
};

// What an execution drew: the pen's positions [n x 2] in metres, x and y in turn, and the configurations that
// led through them, [n x dof] in radians.
struct Trace {
  std::vector<float> pen;
  std::vector<double> joints;
  Eigen::Index points() const { return static_cast<Eigen::Index>(pen.size() / 2); }
};

// Genome: start x and y (through layer 1), pen width, then one to three triplets, each a place of layer 3's
// descriptor (paper, section 4.3).
inline constexpr int kDigitHead = 3, kDigitBlock = 3, kMostArcs = 3;

class Hierarchy {
 public:
  // `spacing` [m] between the points of a line at which layer 1 is asked; 0: at its end alone.
  Hierarchy(const PointLayer& points, const LineLayer& lines, const ArcLayer& arcs, const Frame& frame,
            double spacing);

  // The layer-1 elites that a digit's genome visits, the start first.
  void digit_path(const float* genome, int length, std::vector<std::int32_t>& path) const;
  Trace trace(const std::vector<std::int32_t>& path) const;
  const PointLayer& points() const { return points_; }
  const Frame& frame() const { return frame_; }

 private:
  const PointLayer& points_;
  const LineLayer& lines_;
  const ArcLayer& arcs_;
  Frame frame_;
  double spacing_;
};

// Draws a digit's genome over a hierarchy: image [28 x 28].
void draw_digit(const Hierarchy& hierarchy, const Pencil& pencil, const float* genome, int length,
                float* image);

// Genome -> the learned descriptor's position; fitness minus its reconstruction error.
class DigitEvaluator final : public Evaluator {
 public:
  DigitEvaluator(const Hierarchy& hierarchy, const Pencil& pencil, const Descriptor& descriptor);
  int descriptor_size() const override { return static_cast<int>(descriptor_.dimension()); }
  bool deterministic() const override { return true; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override;

 private:
  const Hierarchy& hierarchy_;
  Pencil pencil_;
  const Descriptor& descriptor_;
};

// The flat baseline (paper, section 5.1): the pen width, then one to three sets of five configurations of all
// joints. The pen draws straight from tip to tip, from the first configuration on.
class FlatDigits {
 public:
  FlatDigits(const Robot& robot, const Frame& frame, const Pencil& pencil);
  static constexpr int kHead = 1;
  int block() const { return kArcSegments * static_cast<int>(robot_.dof()); }
  void draw_digit(const float* genome, int length, float* image) const;

 private:
  const Robot& robot_;
  Frame frame_;
  Pencil pencil_;
};

class FlatDigitEvaluator final : public Evaluator {
 public:
  FlatDigitEvaluator(const FlatDigits& digits, const Descriptor& descriptor);
  int descriptor_size() const override { return static_cast<int>(descriptor_.dimension()); }
  bool deterministic() const override { return true; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override;

 private:
  const FlatDigits& digits_;
  const Descriptor& descriptor_;
};

}  // namespace hbr
