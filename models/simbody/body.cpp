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

struct Body::Plan : Parts {
  int ground = 0;                                          // the part that stands still
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // of it
  std::string impossible = {};  // why nothing moves by these masses; "" where something can
};

namespace {

// What keeps the parts from moving by forces, but for the one that stands still. Throws InputError where one
// has no mass at all.
std::string impossible(const RobotModel& model, const Parts& parts, int ground) {
  for (int p = 0; p < static_cast<int>(parts.parts.size()); ++p) {
    const Part& part = parts.parts[p];
    if (part.parent >= 0 && !(part.mass > 0))
      throw InputError("{}: what joint '{}' moves has no mass; give link '{}' an <inertial>",
                       model.path.string(), model.joints[part.joint].name,
                       model.links[model.joints[part.joint].child].name);
  }
  for (int p = 0; p < static_cast<int>(parts.parts.size()); ++p) {
    const Part& part = parts.parts[p];
    // A root without mass moves with what hangs on it.
    if (p == ground || !(part.mass > 0) || part.fault.kind <= MassFault::Kind::rounded) continue;
    const int link = part.joint < 0 ? 0 : model.joints[part.joint].child;
    return fmt::format("{}: link '{}' and what is fixed to it: {}; it can draw, but has no dynamics",
                       model.path.string(), model.links[link].name, part.fault.why);
  }
  return "";
}

}  // namespace

struct Body::Instance {
  SimTK::MultibodySystem system;
  SimTK::SimbodyMatterSubsystem matter{system};
  std::vector<SimTK::MobilizedBody> bodies;  // of each part
  std::vector<int> slots;                    // of each part's joint: its place among the state's coordinates
  SimTK::State state;
  SimTK::Matrix_<SimTK::Vec3> jacobian;
  SimTK::Matrix mass;
  SimTK::Vector_<SimTK::SpatialVec> forces;
  SimTK::Vector no_torques, no_accelerations, residual;

  // A tree that grows from the part that stands still: joints on the way from there to the root are built
  // from their child to their parent, and mean the same.
  explicit Instance(const RobotModel& model, const Plan& plan) : bodies(plan.parts.size()) {
    const auto n = static_cast<int>(plan.parts.size());
    std::vector<int> mobilised(n, -1);  // of each part's joint: the part that it moves here
    std::vector<int> grown{plan.ground};
    bodies[plan.ground] =
        SimTK::MobilizedBody::Weld(matter.Ground(), transform(plan.pose),
                                   SimTK::Body::Rigid(mass_properties(plan.parts[plan.ground])), {});
    for (std::size_t next = 0; next < grown.size(); ++next) {
      const int from = grown[next];
      const auto grow = [&](int joint_of, int to) {
        if (mobilised[joint_of] >= 0) return;
        mobilised[joint_of] = to;
        bodies[to] = mobilise(model, plan, joint_of, from, to);
        grown.push_back(to);
      };
      if (plan.parts[from].parent >= 0) grow(from, plan.parts[from].parent);
      for (int child = 1; child < n; ++child)
        if (plan.parts[child].parent == from) grow(child, child);
    }
    state = system.realizeTopology();
    system.realizeModel(state);
    for (const int moved : mobilised)
      slots.push_back(moved < 0 ? -1 : static_cast<int>(bodies[moved].getFirstQIndex(state)));
    no_torques.resize(state.getNU());
    no_accelerations.resize(state.getNU());
    no_torques = no_accelerations = 0;
    forces.resize(matter.getNumBodies());
  }

  // Part `to`, hung on part `from` by the joint of one of the two.
  SimTK::MobilizedBody mobilise(const RobotModel& model, const Plan& plan, int joint_of, int from, int to) {
    const Part& part = plan.parts[joint_of];
    const Joint& joint = model.joints[part.joint];
    // A Pin turns about the z axis of its frames, a Slider goes along x.
    const bool slides = joint.kind == Joint::Kind::prismatic, reversed = to != joint_of;
    const SimTK::CoordinateAxis own_axis(slides ? 0 : 2);
    const SimTK::Rotation frame(SimTK::UnitVec3(vec3(joint.axis)), own_axis);
    const SimTK::Transform in_child(frame), in_parent = transform(part.origin) * in_child;
    const SimTK::Transform &inboard = reversed ? in_child : in_parent,
                           &outboard = reversed ? in_parent : in_child;
    const auto direction = reversed ? SimTK::MobilizedBody::Reverse : SimTK::MobilizedBody::Forward;
    const SimTK::Body::Rigid body(mass_properties(plan.parts[to]));
    if (slides) return SimTK::MobilizedBody::Slider(bodies[from], inboard, body, outboard, direction);
    return SimTK::MobilizedBody::Pin(bodies[from], inboard, body, outboard, direction);
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

Body::Body(RobotModel model, std::vector<std::string> moving, const std::map<std::string, double>& rest,
           const std::string& ground)
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
  plan_->impossible = impossible(model_, *plan_, 0);
  try {
    { const Lease first(*this); }  // what Simbody refuses is told here
    if (!ground.empty()) stand_on(model_.link(ground), rest);
  } catch (const InputError&) {
    throw;
  } catch (const std::exception& error) {
    throw InputError("{}: Simbody refuses this body: {}", model_.path.string(), error.what());
  }
}

Body::~Body() = default;

void Body::stand_on(int link, const std::map<std::string, double>& rest) {
  const Parts::Place place = plan_->places[link];
  plan_->pose = link_poses(posture(rest))[link] * place.pose.inverse();
  plan_->ground = place.part;
  plan_->impossible = impossible(model_, *plan_, place.part);
  pool_->idle.clear();  // they stand on the root
  const Lease first(*this);
}

Eigen::VectorXd Body::posture(const std::map<std::string, double>& rest) const {
  Eigen::VectorXd result(dof());
  for (Eigen::Index i = 0; i < dof(); ++i) {
    const auto given = rest.find(moving_[static_cast<std::size_t>(i)]);
    result[i] = std::clamp(given == rest.end() ? 0 : given->second, lower_[i], upper_[i]);
  }
  return result;
}

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

void Body::equations(const Eigen::VectorXd& joints, const Eigen::VectorXd& speeds,
                     const Eigen::Vector3d& gravity, Equations& out) const {
  HBR_CHECK(joints.size() == dof() && speeds.size() == dof(), "joints {}, speeds {}, expected {}",
            joints.size(), speeds.size(), dof());
  if (!plan_->impossible.empty()) throw InputError("{}", plan_->impossible);
  const Lease instance(*this);
  instance->pose(*plan_, joints.data());
  SimTK::State& state = instance->state;
  const std::size_t n = plan_->parts.size();
  for (std::size_t i = 0; i < n; ++i)
    if (instance->slots[i] >= 0)
      state.updU()[instance->slots[i]] = plan_->parts[i].multiplier * speeds[plan_->parts[i].coordinate];
  instance->system.realize(state, SimTK::Stage::Velocity);

  instance->forces = SimTK::SpatialVec(SimTK::Vec3(0), SimTK::Vec3(0));
  for (std::size_t i = 0; i < n; ++i) {
    const SimTK::MobilizedBody& body = instance->bodies[i];
    const SimTK::Vec3 weight = plan_->parts[i].mass * vec3(gravity),
                      arm = body.getBodyRotation(state) * vec3(plan_->parts[i].centre);
    instance->forces[body.getMobilizedBodyIndex()] = {arm % weight, weight};
  }
  instance->matter.calcResidualForceIgnoringConstraints(state, instance->no_torques, instance->forces,
                                                        instance->no_accelerations, instance->residual);
  instance->matter.calcM(state, instance->mass);

  // Joints that follow others add up in the coordinate that they follow.
  out.mass.setZero(dof(), dof());
  out.bias.setZero(dof());
  for (std::size_t i = 0; i < n; ++i) {
    if (instance->slots[i] < 0) continue;
    const Part& a = plan_->parts[i];
    out.bias[a.coordinate] += a.multiplier * instance->residual[instance->slots[i]];
    for (std::size_t k = 0; k < n; ++k) {
      if (instance->slots[k] < 0) continue;
      const Part& b = plan_->parts[k];
      out.mass(a.coordinate, b.coordinate) +=
          a.multiplier * b.multiplier * instance->mass(instance->slots[i], instance->slots[k]);
    }
  }
}

std::vector<bool> Body::moves(int link) const {
  // The joints of the parts from the link to the root, or from what stands still to the root, but not of
  // both.
  std::vector<bool> on_path(plan_->parts.size(), false);
  for (const int end : {plan_->places.at(link).part, plan_->ground})
    for (int p = end; p > 0; p = plan_->parts[p].parent) on_path[p] = !on_path[p];
  std::vector<bool> result(dof(), false);
  for (std::size_t p = 1; p < on_path.size(); ++p)
    if (on_path[p]) result[plan_->parts[p].coordinate] = true;
  return result;
}

}  // namespace hbr
