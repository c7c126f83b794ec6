// The flat baseline of section 5.1: digits by configurations of all joints, judged by the same descriptor.
#pragma once

#include <vector>

#include "pipeline/hierarchy/drawing_settings.h"
#include "pipeline/hierarchy/layer_model.h"
#include "pipeline/hierarchy/layers/arc_geometry.h"

namespace hbr::inline hierarchy {

struct FlatDigitsSettings {
  double half_side = 0;
  std::string pen;
  std::string start;
  double length_rate = 0;
  PencilSettings pencil;
};
template <class Fields>
void describe(Fields& f, FlatDigitsSettings& s) {
  describe_half_side(f, s.half_side);
  f.choice("pen", s.pen, {"straight", "joints"},
           "between configurations: straight from tip to tip, or all joints turning evenly");
  f.choice("start", s.start, {"first", "straight_arm"},
           "of the pen: the first configuration, or the straight arm");
  describe_length_rate(f, s.length_rate);
  f.table("pencil", s.pencil, "from trace to image");
}

// What the pen does between two configurations: a straight segment from tip to tip, or the way of the tip
// while all joints turn evenly, in kFlatSubSteps segments. And where it begins: at the first configuration,
// or at the straight arm (all joints at the middle of their range).
enum class FlatPen { kStraight, kJoints };
enum class FlatDigitStart { kFirst, kStraightArm };
inline constexpr int kFlatSubSteps = 8;
struct FlatDigitReading {
  FlatPen pen = FlatPen::kStraight;
  FlatDigitStart start = FlatDigitStart::kFirst;
};

// Genome: the pen width, then one to three sets of five configurations of all joints.
class FlatDigits {
 public:
  FlatDigits(const Robot& robot, const Frame& frame, const PencilSettings& pencil,
             FlatDigitReading reading = {});
  static constexpr int kHead = 1, kMaxBlocks = 3;
  int block() const { return kArcSegments * static_cast<int>(robot_.dof()); }
  // Draws n genomes, genomes + i stride of lengths[i] genes: images [n x 28 x 28]. Asks the robot once.
  void draw_digits(Eigen::Index n, const float* genomes, Eigen::Index stride, const std::int32_t* lengths,
                   float* images) const;
  // The points through which the pen goes, m.
  std::vector<Eigen::Vector2d> tips(const float* genome, int length) const;

 private:
  // Appends the configurations that the pen passes through, [points x dof] in radians.
  void append_joints(const float* genome, int length, std::vector<double>& joints) const;

  const Robot& robot_;
  Frame frame_;
  PencilSettings pencil_;
  FlatDigitReading reading_;
  std::vector<double> straight_arm_;
};

class FlatDigitEvaluator final : public Evaluator {
 public:
  FlatDigitEvaluator(std::shared_ptr<const FlatDigits> digits, const Descriptor& descriptor);
  int descriptor_size() const override { return static_cast<int>(descriptor_.dimension()); }
  bool deterministic() const override { return true; }
  void evaluate(Batch& batch, Eigen::Index begin, Eigen::Index end, Seed seed) const override;
  const FlatDigits& digits() const { return *digits_; }

 private:
  std::shared_ptr<const FlatDigits> digits_;
  const Descriptor& descriptor_;
};

// Of a layer that has a descriptor; throws InputError where it is of another kind.
const FlatDigits& flat_digits_of(const LayerModel& layer);

std::unique_ptr<LayerModel> make_flat_digits(const FlatDigitsSettings& settings, const Surroundings& around);

}  // namespace hbr::inline hierarchy
