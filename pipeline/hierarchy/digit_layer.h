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
            double spacing, OutOfRange out_of_range = OutOfRange::kRadius);

  // The layer-1 elites that a digit's genome visits, the start first. False where a triplet is rejected: the
  // path ends before it.
  bool digit_path(const float* genome, int length, std::vector<std::int32_t>& path) const;
  Trace trace(const std::vector<std::int32_t>& path) const;
  const PointLayer& points() const { return points_; }
  const Frame& frame() const { return frame_; }

 private:
  const PointLayer& points_;
  const LineLayer& lines_;
  const ArcLayer& arcs_;
  Frame frame_;
  double spacing_;
  OutOfRange out_of_range_;
};

// Draws a digit's genome over a hierarchy: image [28 x 28]. False, and the image as it was, where a triplet
// is rejected.
bool draw_digit(const Hierarchy& hierarchy, const Pencil& pencil, const float* genome, int length,
                float* image);

// Genome -> the learned descriptor's position; fitness minus its reconstruction error. No behaviour where a
// triplet is rejected.
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

// What the flat baseline's pen does between two configurations: a straight segment from tip to tip, or the
// way of the tip while all joints turn evenly, in kFlatSubSteps segments. And where it begins: at the first
// configuration, or at the straight arm (all joints at the middle of their range).
enum class FlatPen { kStraight, kJoints };
enum class FlatDigitStart { kFirst, kStraightArm };
inline constexpr int kFlatSubSteps = 8;
struct FlatDigitReading {
  FlatPen pen = FlatPen::kStraight;
  FlatDigitStart start = FlatDigitStart::kFirst;
};
// "straight" or "joints", "first" or "straight_arm".
FlatDigitReading flat_digit_reading(const std::string& pen, const std::string& start);

// The flat baseline (paper, section 5.1): the pen width, then one to three sets of five configurations of all
// joints.
class FlatDigits {
 public:
  FlatDigits(const Robot& robot, const Frame& frame, const Pencil& pencil, FlatDigitReading reading = {});
  static constexpr int kHead = 1;
  int block() const { return kArcSegments * static_cast<int>(robot_.dof()); }
  // Draws n genomes, genomes + i stride of lengths[i] genes: images [n x 28 x 28]. Asks the robot once.
  void draw_digits(Eigen::Index n, const float* genomes, Eigen::Index stride, const std::int32_t* lengths,
                   float* images) const;

 private:
  // Appends the configurations that the pen passes through, [points x dof] in radians.
  void append_joints(const float* genome, int length, std::vector<double>& joints) const;

  const Robot& robot_;
  Frame frame_;
  Pencil pencil_;
  FlatDigitReading reading_;
  std::vector<double> straight_arm_;
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
