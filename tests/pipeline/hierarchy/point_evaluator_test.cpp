// What layer 1 accepts, on a robot whose joints are the pen's coordinates and which touches something in a
// corner.
#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/core/check.h"
#include "pipeline/hierarchy/layers/points.h"

namespace hbr {
namespace {

class Slider final : public Robot {
 public:
  std::string name() const override { return "slider"; }
  const Eigen::VectorXd& lower() const override { return lower_; }
  const Eigen::VectorXd& upper() const override { return upper_; }
  double off_plane_tolerance() const override { return 0.02; }
  bool clear(const double* joints, double half_side) const override {
    return std::min(joints[0], joints[1]) < 0.6 * half_side;
  }
  void pens(Eigen::Index n, const double* joints, Pen* pens) const override {
    for (Eigen::Index i = 0; i < n; ++i) pens[i] = {{joints[3 * i], joints[3 * i + 1]}, joints[3 * i + 2]};
  }

 private:
  Eigen::VectorXd lower_ = Eigen::VectorXd::Constant(3, -1), upper_ = Eigen::VectorXd::Constant(3, 1);
};

TEST(PointEvaluator, TakesWhatIsInTheAreaOnThePlaneAndClear) {
  const Slider slider;
  const Frame frame{0.5, 0.1};
  struct Case {
    double x, y, off_plane;
    bool valid;
  };
  for (const Case& c : {Case{0, 0, 0, true}, Case{0.49, -0.49, 0.019, true}, Case{0.49, 0.2, -0.019, true},
                        Case{0.49, 0.49, 0, false},

                        Case{0.51, 0, 0, false}, Case{-0.51, 0, 0, false}, Case{0, 0.51, 0, false},
                        Case{0, -0.51, 0, false}, Case{0, 0, 0.021, false}, Case{0, 0, -0.021, false}})
    for (const JointCost& cost : joint_costs()) {
      Batch batch(1, 3, 2);
      batch.genome.row(0) = Eigen::RowVector3d(c.x + 1, c.y + 1, c.off_plane + 1).cast<float>() / 2;
      PointEvaluator(slider, frame, cost).evaluate(batch, 0, 1, Seed(0));
      EXPECT_EQ(batch.valid[0], c.valid) << c.x << " " << c.y << " " << c.off_plane;
      const double q[3] = {c.x, c.y, c.off_plane};
      EXPECT_NEAR(batch.fitness[0], -cost.of(q, 3), 1e-6);
      EXPECT_NEAR(batch.descriptor(0, 0), c.x + 0.5, 1e-6);
      EXPECT_NEAR(batch.descriptor(0, 1), c.y + 0.5, 1e-6);
    }
  EXPECT_THROW(make_points({0.5, "variance"}, {slider}), InputError);
}

}  // namespace
}  // namespace hbr
