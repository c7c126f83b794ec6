#include "models/robot/body/motion_tree.h"

namespace hbr::inline robots {

// Six-dimensional vectors about the origin of the ground's frame: of motion, the velocity of the body and
// that of its point at the origin; of force, the moment about the origin and the force.
struct Spatial {
  Eigen::Vector3d turning = Eigen::Vector3d::Zero(), straight = Eigen::Vector3d::Zero();

  Spatial operator+(const Spatial& b) const { return {turning + b.turning, straight + b.straight}; }
  Spatial operator*(double s) const { return {s * turning, s * straight}; }
  double dot(const Spatial& b) const { return turning.dot(b.turning) + straight.dot(b.straight); }
};

// Of a rigid body, about the origin.
struct SpatialInertia {
  double mass = 0;
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();  // mass * centre
  Eigen::Matrix3d turning = Eigen::Matrix3d::Zero();

  Spatial operator*(const Spatial& v) const {
    return {turning * v.turning + moment.cross(v.straight), mass * v.straight - moment.cross(v.turning)};
  }
  void operator+=(const SpatialInertia& b) {
    mass += b.mass;
    moment += b.moment;
    turning += b.turning;
  }
};

namespace {

// How a motion changes that is carried along by the motion v; and a force.
Spatial carried_motion(const Spatial& v, const Spatial& m) {
  return {v.turning.cross(m.turning), v.turning.cross(m.straight) + v.straight.cross(m.turning)};
}
Spatial carried_force(const Spatial& v, const Spatial& f) {
  return {v.turning.cross(f.turning) + v.straight.cross(f.straight), v.turning.cross(f.straight)};
}

// The inertia that a mass in one point has about the origin.
Eigen::Matrix3d point_inertia(double mass, const Eigen::Vector3d& c) {
  return mass * (c.squaredNorm() * Eigen::Matrix3d::Identity() - c * c.transpose());
}

}  // namespace

struct MotionTree::MovingLimb {
  Eigen::Isometry3d pose;
  Spatial axis;              // of the joint: the motion of what it carries, for a speed of 1
  Spatial speed;             // of the part
  Spatial acceleration;      // with gravity
  Spatial force;             // on the part, and in the end on what it carries
  SpatialInertia composite;  // likewise
};

MotionTree::MotionTree(const RobotModel& model, const Parts& parts, int ground, const Eigen::Isometry3d& pose,
                       Eigen::Index dof)
    : pose_(pose),
      ground_mass_(parts.parts[ground].mass),
      ground_centre_(pose * parts.parts[ground].centre),
      dof_(dof) {
  struct Grown {
    int part, limb;  // the part, and its place among the limbs
  };
  std::vector<bool> hung(parts.parts.size(), false);
  hung[ground] = true;
  std::vector<Grown> grown{{ground, -1}};
  carriers_.resize(parts.parts.size());
  for (std::size_t next = 0; next < grown.size(); ++next) {
    const Grown from = grown[next];
    const auto hang = [&](int to, int joint_of) {
      if (hung[to]) return;
      hung[to] = true;
      const Part &part = parts.parts[to], &moved = parts.parts[joint_of];
      const Joint& joint = model.joints[moved.joint];
      grown.push_back({to, static_cast<int>(limbs_.size())});
      carriers_[to] = carriers_[from.part];
      carriers_[to].push_back(grown.back().limb);
      limbs_.push_back({to, from.limb, to != joint_of, joint.kind == Joint::Kind::prismatic, moved.origin,
                        joint.axis, moved.coordinate, moved.multiplier, moved.offset, part.mass, part.centre,
                        part.inertia_origin - point_inertia(part.mass, part.centre)});
    };
    if (const int parent = parts.parts[from.part].parent; parent >= 0) hang(parent, from.part);
    for (int child = 1; child < static_cast<int>(parts.parts.size()); ++child)
      if (parts.parts[child].parent == from.part) hang(child, child);
  }
}

Eigen::Isometry3d MotionTree::pose_of(const Limb& limb, double position, const Eigen::Isometry3d& carrier) {
  Eigen::Isometry3d joint = limb.origin;
  if (limb.slides)
    joint.translate(position * limb.axis);
  else
    joint.rotate(Eigen::AngleAxisd(position, limb.axis));
  return limb.reversed ? carrier * joint.inverse() : carrier * joint;
}

// Where the joint is in its child; turned back where the child carries.
Eigen::Vector3d MotionTree::axis_of(const Limb& limb, const Eigen::Isometry3d& child) {
  return (limb.reversed ? -1 : 1) * (child.linear() * limb.axis);
}

Eigen::Vector3d MotionTree::place(int part, const Eigen::Vector3d& point, const double* joints,
                                  Eigen::Matrix3Xd* slopes) const {
  Eigen::Isometry3d pose = pose_;
  Eigen::Matrix3Xd turning;  // by each joint: how the part turns; slopes: how its point at the origin moves
  if (slopes) {
    turning.setZero(3, dof_);
    slopes->setZero(3, dof_);
  }
  for (const int i : carriers_.at(part)) {
    const Limb& limb = limbs_[i];
    const Eigen::Isometry3d carrier = pose;
    pose = pose_of(limb, limb.multiplier * joints[limb.coordinate] + limb.offset, carrier);
    if (!slopes) continue;
    const Eigen::Isometry3d& child = limb.reversed ? carrier : pose;
    const Eigen::Vector3d axis = limb.multiplier * axis_of(limb, child);
    if (limb.slides) {
      slopes->col(limb.coordinate) += axis;
    } else {
      turning.col(limb.coordinate) += axis;
      slopes->col(limb.coordinate) += child.translation().cross(axis);
    }
  }
  const Eigen::Vector3d place = pose * point;
  if (slopes)
    for (Eigen::Index c = 0; c < dof_; ++c) slopes->col(c) += Eigen::Vector3d(turning.col(c)).cross(place);
  return place;
}

std::vector<Eigen::Isometry3d> MotionTree::poses(const double* joints) const {
  std::vector<Eigen::Isometry3d> all(carriers_.size(), pose_);
  for (const Limb& limb : limbs_)
    all[limb.part] = pose_of(limb, limb.multiplier * joints[limb.coordinate] + limb.offset,
                             limb.on < 0 ? pose_ : all[limbs_[limb.on].part]);
  return all;
}

std::vector<MotionTree::MovingLimb> MotionTree::moved(const Eigen::VectorXd& joints,
                                                      const Eigen::VectorXd& speeds,
                                                      const Eigen::VectorXd* accelerations,
                                                      const Eigen::Vector3d& gravity) const {
  std::vector<MovingLimb> moving(limbs_.size());
  for (std::size_t i = 0; i < moving.size(); ++i) {
    const Limb& limb = limbs_[i];
    MovingLimb& now = moving[i];
    const double speed = limb.multiplier * speeds[limb.coordinate];
    const Eigen::Isometry3d& carrier = limb.on < 0 ? pose_ : moving[limb.on].pose;
    now.pose = pose_of(limb, limb.multiplier * joints[limb.coordinate] + limb.offset, carrier);
    const Eigen::Isometry3d& child = limb.reversed ? carrier : now.pose;
    const Eigen::Vector3d axis = axis_of(limb, child);
    now.axis =
        limb.slides ? Spatial{Eigen::Vector3d::Zero(), axis} : Spatial{axis, child.translation().cross(axis)};

    const Spatial own = now.axis * speed;
    now.speed = own;
    now.acceleration = {Eigen::Vector3d::Zero(), -gravity};
    if (limb.on >= 0) {
      now.speed = moving[limb.on].speed + own;
      now.acceleration = moving[limb.on].acceleration;
    }
    now.acceleration = now.acceleration + carried_motion(now.speed, own);
    if (accelerations)
      now.acceleration = now.acceleration + now.axis * (limb.multiplier * (*accelerations)[limb.coordinate]);

    const Eigen::Vector3d centre = now.pose * limb.centre;
    now.composite = {
        limb.mass, limb.mass * centre,
        now.pose.linear() * limb.inertia * now.pose.linear().transpose() + point_inertia(limb.mass, centre)};
    now.force = now.composite * now.acceleration + carried_force(now.speed, now.composite * now.speed);
  }
  return moving;
}

void MotionTree::equations(const Eigen::VectorXd& joints, const Eigen::VectorXd& speeds,
                           const Eigen::Vector3d& gravity, Equations& out) const {
  std::vector<MovingLimb> moving = moved(joints, speeds, nullptr, gravity);
  // Joints that follow others add up in the coordinate that they follow.
  out.mass.setZero(dof_, dof_);
  out.bias.setZero(dof_);
  for (std::size_t i = moving.size(); i-- > 0;) {
    const Limb& limb = limbs_[i];
    const MovingLimb& now = moving[i];
    out.bias[limb.coordinate] += limb.multiplier * now.axis.dot(now.force);
    const Spatial force = now.composite * now.axis;
    for (int k = static_cast<int>(i); k >= 0; k = limbs_[k].on) {
      const Limb& carrier = limbs_[k];
      const double entry = limb.multiplier * carrier.multiplier * moving[k].axis.dot(force);
      out.mass(limb.coordinate, carrier.coordinate) += entry;
      if (k != static_cast<int>(i)) out.mass(carrier.coordinate, limb.coordinate) += entry;
    }
    if (limb.on >= 0) {
      moving[limb.on].composite += now.composite;
      moving[limb.on].force = moving[limb.on].force + now.force;
    }
  }
}

Wrench MotionTree::reaction(const Eigen::VectorXd& joints, const Eigen::VectorXd& speeds,
                            const Eigen::VectorXd& accelerations, const Eigen::Vector3d& gravity) const {
  const Eigen::Vector3d weight = ground_mass_ * gravity;
  Spatial all{-ground_centre_.cross(weight), -weight};
  // Every force but the ground's is one between two limbs.
  for (const MovingLimb& limb : moved(joints, speeds, &accelerations, gravity)) all = all + limb.force;
  return {all.turning, all.straight};
}

}  // namespace hbr::inline robots
