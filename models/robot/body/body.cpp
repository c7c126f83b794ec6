#include "models/robot/body/body.h"

#include <algorithm>
#include <mutex>

#include "models/robot/body/simbody_system.h"
#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

// What keeps the parts from moving by forces, but for the one that stands still.
std::string impossible(const RobotModel& model, const Parts& parts, int ground) {
  for (int p = 0; p < static_cast<int>(parts.parts.size()); ++p) {
    const Part& part = parts.parts[p];
    // A root without mass moves with what hangs on it.
    if (p == ground || part.fault.kind <= MassFault::Kind::rounded || (p == 0 && !(part.mass > 0))) continue;
    const int link = part.joint < 0 ? 0 : model.joints[part.joint].child;
    return fmt::format("{}: link '{}' and what is fixed to it: {}; it can draw, but has no dynamics",
                       model.path.string(), model.links[link].name, part.fault.why);
  }
  return "";
}

}  // namespace

struct Body::Pool {
  std::mutex mutex;
  std::vector<std::unique_ptr<SimbodySystem>> idle;
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
    instance_ = std::make_unique<SimbodySystem>(body.model_, *body.plan_);
  }
  ~Lease() {
    const std::lock_guard<std::mutex> lock(pool_.mutex);
    pool_.idle.push_back(std::move(instance_));
  }
  Lease(const Lease&) = delete;
  SimbodySystem* operator->() const { return instance_.get(); }

 private:
  Pool& pool_;
  std::unique_ptr<SimbodySystem> instance_;
};

Body::Body(RobotModel model, std::vector<std::string> moving, const std::map<std::string, double>& rest,
           const std::string& ground)
    : model_(std::move(model)),
      moving_(std::move(moving)),
      lower_(static_cast<Eigen::Index>(moving_.size())),
      upper_(lower_.size()),
      plan_(std::make_unique<SystemPlan>(SystemPlan{join_parts(model_, moving_, rest)})),
      tree_(std::make_unique<MotionTree>(model_, *plan_, plan_->ground, plan_->pose, lower_.size())),
      pool_(std::make_unique<Pool>()) {
  for (std::size_t i = 0; i < moving_.size(); ++i) {
    const auto [lower, upper] = model_.range(model_.joint(moving_[i]));
    lower_[static_cast<Eigen::Index>(i)] = lower;
    upper_[static_cast<Eigen::Index>(i)] = upper;
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
  tree_ = std::make_unique<MotionTree>(model_, *plan_, plan_->ground, plan_->pose, dof());
  pool_->idle.clear();  // they stand on the root
  const Lease first(*this);
}

Eigen::VectorXd Body::posture(const std::map<std::string, double>& rest) const {
  Eigen::VectorXd result(dof());
  for (Eigen::Index i = 0; i < dof(); ++i) {
    const Joint& joint = model_.joints[model_.joint(moving_[static_cast<std::size_t>(i)])];
    const auto given = rest.find(joint.name);
    result[i] =
        std::clamp(given == rest.end() ? 0 : joint.within_a_turn(given->second), lower_[i], upper_[i]);
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
  const std::vector<Eigen::Isometry3d> parts = tree_->poses(joints.data());
  std::vector<Eigen::Isometry3d> poses;
  poses.reserve(plan_->places.size());
  for (const Parts::Place& place : plan_->places) poses.push_back(parts[place.part] * place.pose);
  return poses;
}

void Body::positions(int link, Eigen::Index n, const double* joints, Eigen::Vector3d* out) const {
  for (Eigen::Index i = 0; i < n; ++i) out[i] = position(link, joints + i * dof());
}

Eigen::Vector3d Body::position(int link, const double* joints, Eigen::Matrix3Xd* jacobian) const {
  const Parts::Place& place = plan_->places.at(link);
  return tree_->place(place.part, place.pose.translation(), joints, jacobian);
}

const std::string& Body::impossible_dynamics() const { return plan_->impossible; }

void Body::equations(const Eigen::VectorXd& joints, const Eigen::VectorXd& speeds,
                     const Eigen::Vector3d& gravity, Equations& out) const {
  HBR_CHECK(joints.size() == dof() && speeds.size() == dof(), "joints {}, speeds {}, expected {}",
            joints.size(), speeds.size(), dof());
  if (!plan_->impossible.empty()) throw InputError("{}", plan_->impossible);
  tree_->equations(joints, speeds, gravity, out);
}

Wrench Body::reaction(const Eigen::VectorXd& joints, const Eigen::VectorXd& speeds,
                      const Eigen::VectorXd& accelerations, const Eigen::Vector3d& gravity) const {
  HBR_CHECK(joints.size() == dof() && speeds.size() == dof() && accelerations.size() == dof(),
            "joints {}, speeds {}, accelerations {}, expected {}", joints.size(), speeds.size(),
            accelerations.size(), dof());
  if (!plan_->impossible.empty()) throw InputError("{}", plan_->impossible);
  return tree_->reaction(joints, speeds, accelerations, gravity);
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

MovingParts Body::moving_parts() const {
  HBR_CHECK(plan_->ground == 0, "part {} stands still, expected the root's", plan_->ground);
  const Lease instance(*this);
  MovingParts result{{MovingPart()}, plan_->places};
  for (std::size_t i = 1; i < plan_->parts.size(); ++i) {
    const Part& part = plan_->parts[i];
    const SimTK::MobilizedBody& body = instance->bodies[i];
    const Eigen::Isometry3d outboard = eigen(body.getOutboardFrame(instance->state));
    MovingPart moving;
    moving.parent = part.parent;
    moving.slides = SimTK::MobilizedBody::Slider::isInstanceOf(body);
    moving.origin = eigen(body.getInboardFrame(instance->state)) * outboard.inverse();
    // A Pin turns about the z axis of its frames, a Slider goes along x.
    moving.axis = outboard.linear().col(moving.slides ? 0 : 2);
    moving.coordinate = part.coordinate;
    moving.multiplier = part.multiplier;
    moving.offset = part.offset;
    result.parts.push_back(moving);
  }
  return result;
}

}  // namespace hbr::inline robots
