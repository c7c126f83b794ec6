#include "pipeline/hierarchy/point_layer.h"

#include "pipeline/hierarchy/executions.h"
#include "pipeline/hierarchy/joints.h"

namespace hbr::inline hierarchy {
namespace {
// How far displacements lead out of the drawing area at most where look-ups are to be fast, descriptor units.
constexpr float kBeyond = 0.25f;
}  // namespace

PointLayer::PointLayer(const Elites& elites, const Robot& robot, const Frame& frame)
    : frame_(frame),
      table_(elites.measures, -kBeyond, 1 + kBeyond),
      mean_(elites.size()),
      variance_(elites.size()) {
  position_.resize(elites.size(), 2);
  joints_.resize(elites.size(), robot.dof());
  for (Eigen::Index i = 0; i < elites.size(); ++i) {
    position_.row(i) = frame.point(elites.measures.row(i).transpose().cast<double>()).transpose();
    decode_joints(robot, elites.solution.row(i).data(), joints_.row(i).data());
    mean_[i] = joints_.row(i).mean();
    variance_[i] = joint_variance(joints_.row(i).data(), robot.dof());
  }
}

void PointLayer::perform(Executions& executions, Group group, const std::int32_t* elites, int repeat) const {
  if (repeat == 1) return executions.move(group, elites);
  std::vector<std::int32_t> all(group.size());
  for (std::size_t i = 0; i < group.size(); ++i) all[i] = elites[i / repeat];
  executions.move(group, all.data());
}

}  // namespace hbr::inline hierarchy
