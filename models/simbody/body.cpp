// The only file that sees Simbody. It is compiled as C++17 with assertions: see CMakeLists.txt.
#include "models/simbody/body.h"

#include <Simbody.h>

#include <algorithm>
#include <mutex>

#include "models/simbody/parts.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace {

SimTK::Vec3 vec3(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }
Eigen::Vector3d eigen(const SimTK::Vec3& v) { return {v[0], v[1], v[2]}; }

SimTK::Transform transform(const Eigen::Isometry3d& t) {
  SimTK::Mat33 m;
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) m(r, c) = t.linear()(r, c);
  return {SimTK::Rotation(m), vec3(t.translation())};
}

Eigen::Isometry3d eigen(const SimTK::Transform& t) {
  Eigen::Isometry3d result = Eigen::Isometry3d::Identity();
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 3; ++c) result.linear()(r, c) = t.R().row(r)[c];
  result.translation() = eigen(t.p());
  return result;
}

SimTK::MassProperties mass_properties(const Part& part) {
  const Eigen::Matrix3d& i = part.inertia_origin;
  return {part.mass, vec3(part.centre),
          SimTK::Inertia(SimTK::SymMat33(i(0, 0), i(1, 0), i(1, 1), i(2, 0), i(2, 1), i(2, 2)))};
}

}  // namespace

struct Body::Plan : Parts {};

struct Body::Instance {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  std::vector<SimTK::MobilizedBody> bodies;  // of each part
  std::vector<int> slots;                    // of each part: its place in the state's coordinates
  SimTK::State state;
  SimTK::Matrix_<SimTK::Vec3> jacobian;

  explicit Instance(const RobotModel& model, const Plan& plan) {
    for (const Part& part : plan.parts) {
      const SimTK::Body::Rigid body(mass_properties(part));
      if (part.parent < 0) {
        bodies.push_back(SimTK::MobilizedBody::Weld(matter.Ground(), body));
        continue;
      }
      const Joint& joint = model.joints[part.joint];
      // A Pin turns about the z axis of its frames, a Slider goes along x.
      const bool slides = joint.kind == Joint::Kind::prismatic;
      const SimTK::CoordinateAxis own_axis(slides ? 0 : 2);
      const SimTK::Rotation frame(SimTK::UnitVec3(vec3(joint.axis)), own_axis);
      const SimTK::Transform in_child(frame), in_parent = transform(part.origin) * in_child;
      SimTK::MobilizedBody& parent = bodies[part.parent];
      if (slides)
        bodies.push_back(SimTK::MobilizedBody::Slider(parent, in_parent, body, in_child));
      else
        bodies.push_back(SimTK::MobilizedBody::Pin(parent, in_parent, body, in_child));
    }
    state = system.realizeTopology();
    system.realizeModel(state);
    for (std::size_t i = 0; i < plan.parts.size(); ++i)
      slots.push_back(plan.parts[i].parent < 0 ? -1 : static_cast<int>(bodies[i].getFirstQIndex(state)));
  }

  void pose(const Plan& plan, const double* joints) {
    SimTK::Vector& q = state.updQ();
    for (std::size_t i = 1; i < slots.size(); ++i) {
      const Part& part = plan.parts[i];
      q[slots[i]] = part.multiplier * joints[part.coordinate] + part.offset;
    }
    system.realize(state, SimTK::Stage::Position);
  }
};

struct Body::Pool {
  std::mutex mutex;
  std::vector<std::unique_ptr<Instance>> idle;
};

// An instance for as long as the lease lives.
class Body::Lease {
 public:
  explicit Lease(const Body& body) : pool_(*body.pool_) {
    {
      const std::lock_guard<std::mutex> lock(pool_.mutex);
      if (!pool_.idle.empty()) {
        instance_ = std::move(pool_.idle.back());
        pool_.idle.pop_back();
        return;
      }
    }
    instance_ = std::make_unique<Instance>(body.model_, *body.plan_);
  }
  ~Lease() {
    const std::lock_guard<std::mutex> lock(pool_.mutex);
    pool_.idle.push_back(std::move(instance_));
  }
  Lease(const Lease&) = delete;
  Instance* operator->() const { return instance_.get(); }

 private:
  Pool& pool_;
  std::unique_ptr<Instance> instance_;
};

Body::Body(RobotModel model, std::vector<std::string> moving, const std::map<std::string, double>& rest)
    : model_(std::move(model)),
      moving_(std::move(moving)),
      lower_(static_cast<Eigen::Index>(moving_.size())),
      upper_(lower_.size()),
      plan_(std::make_unique<Plan>(Plan{join_parts(model_, moving_, rest)})),
      pool_(std::make_unique<Pool>()) {
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    const Joint& joint = model_.joints[model_.joint(moving_[i])];
    lower_[static_cast<Eigen::Index>(i)] = joint.lower;
    upper_[static_cast<Eigen::Index>(i)] = joint.upper;
  }
  try {
    Lease first(*this);  // what Simbody refuses is told here
  } catch (const std::exception& error) {
    throw InputError("{}: Simbody refuses this body: {}", model_.path.string(), error.what());
  }
}

Body::~Body() = default;

double Body::mass() const {
  const Lease instance(*this);
  return instance->matter.calcSystemMass(instance->state);
}

Eigen::Vector3d Body::centre_of_mass(const Eigen::VectorXd& joints) const {
  HBR_CHECK(joints.size() == dof(), "joints {}, expected {}", joints.size(), dof());
  const Lease instance(*this);
  instance->pose(*plan_, joints.data());
  return eigen(instance->matter.calcSystemMassCenterLocationInGround(instance->state));
}

std::vector<Eigen::Isometry3d> Body::link_poses(const Eigen::VectorXd& joints) const {
  HBR_CHECK(joints.size() == dof(), "joints {}, expected {}", joints.size(), dof());
  const Lease instance(*this);
  instance->pose(*plan_, joints.data());
  std::vector<Eigen::Isometry3d> poses;
  for (const Parts::Place& place : plan_->places)
    poses.push_back(eigen(instance->bodies[place.part].getBodyTransform(instance->state)) * place.pose);
  return poses;
}

void Body::positions(int link, Eigen::Index n, const double* joints, Eigen::Vector3d* out) const {
  const Lease instance(*this);
  const Parts::Place& place = plan_->places.at(link);
  const SimTK::MobilizedBody& body = instance->bodies[place.part];
  const SimTK::Vec3 station = vec3(place.pose.translation());
  for (Eigen::Index i = 0; i < n; ++i) {
    instance->pose(*plan_, joints + i * dof());
    out[i] = eigen(body.findStationLocationInGround(instance->state, station));
  }
}

Eigen::Vector3d Body::position(int link, const double* joints, Eigen::Matrix3Xd* jacobian) const {
  const Lease instance(*this);
  const Parts::Place& place = plan_->places.at(link);
  const SimTK::MobilizedBody& body = instance->bodies[place.part];
  const SimTK::Vec3 station = vec3(place.pose.translation());
  instance->pose(*plan_, joints);
  if (jacobian) {
    SimTK::Matrix_<SimTK::Vec3>& by_speed = instance->jacobian;
    instance->matter.calcStationJacobian(
        instance->state, SimTK::Array_<SimTK::MobilizedBodyIndex>(1, body.getMobilizedBodyIndex()),
        SimTK::Array_<SimTK::Vec3>(1, station), by_speed);
    jacobian->setZero(3, dof());
    for (std::size_t i = 1; i < plan_->parts.size(); ++i) {
      const Part& part = plan_->parts[i];
      jacobian->col(part.coordinate) += part.multiplier * eigen(by_speed(0, instance->slots[i]));
    }
  }
  return eigen(body.findStationLocationInGround(instance->state, station));
}

std::vector<bool> Body::moves(int link) const {
  std::vector<bool> result(dof(), false);
  for (int p = plan_->places.at(link).part; p > 0; p = plan_->parts[p].parent)
    result[plan_->parts[p].coordinate] = true;
  return result;
}

}  // namespace hbr
