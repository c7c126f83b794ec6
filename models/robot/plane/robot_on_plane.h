// A Simbody body that draws on a plane.
#pragma once

#include <memory>

#include "models/robot/body/body.h"
#include "models/robot/plane/clearance.h"
#include "models/robot/plane/drawing_plane.h"
#include "models/robot/plane/robot_settings.h"
#include "pipeline/hierarchy/robot.h"

namespace hbr::inline robots {

class RobotOnPlane final : public Robot {
 public:
  // The pen is the origin of the link `tip`, and draws within the tolerance [m] of the plane. Throws
  // InputError for an unknown tip or a moving joint of the body that does not move it.
  RobotOnPlane(std::string name, std::shared_ptr<const Body> body, const std::string& tip,
               const DrawingPlane& plane, double off_plane_tolerance = 0);

  std::string name() const override { return name_; }
  const Eigen::VectorXd& lower() const override { return body_->lower(); }
  const Eigen::VectorXd& upper() const override { return body_->upper(); }
  std::string unit(Eigen::Index joint) const override;
  // Positions in metres of the arm, off_plane in metres of the robot (positive on the robot's side).
  void pens(Eigen::Index n, const double* joints, Pen* pens) const override;

  double off_plane_tolerance() const override { return tolerance_; }
  bool clear(const double* joints, double half_side) const override {
    return clearance_->clear(joints, {plane_, half_side});
  }

  const Body& body() const { return *body_; }
  const DrawingPlane& plane() const { return plane_; }
  const Clearance& clearance() const { return *clearance_; }
  int tip() const { return tip_; }

 private:
  std::string name_;
  std::shared_ptr<const Body> body_;
  int tip_;
  DrawingPlane plane_;
  double tolerance_;
  std::shared_ptr<const Clearance> clearance_;
};

// The robot of a profile's table on that plane: its drawing joints move, all others rest. Throws InputError
// where one of them can't stand where the table has it.
RobotOnPlane make_robot(const RobotSettings& settings, const DrawingPlane& plane);

}  // namespace hbr::inline robots
