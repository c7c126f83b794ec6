#include "models/robot/body/servos.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

// The path's state in the body's coordinates; what does not draw stays.
JointPath::Point in_body(const JointPath::Point& point, const std::vector<int>& drawing,
                         const Eigen::VectorXd& posture) {
  const Eigen::Index dof = posture.size();
  JointPath::Point all{posture, Eigen::VectorXd::Zero(dof), Eigen::VectorXd::Zero(dof)};
  for (std::size_t k = 0; k < drawing.size(); ++k) {
    const auto from = static_cast<Eigen::Index>(k);
    all.position[drawing[k]] = point.position[from];
    all.velocity[drawing[k]] = point.velocity[from];
    all.acceleration[drawing[k]] = point.acceleration[from];
  }
  return all;
}

void raise(Eigen::VectorXd& greatest, const Eigen::VectorXd& values, const Eigen::VectorXd& limits) {
  for (Eigen::Index i = 0; i < values.size(); ++i)
    if (limits[i] > 0) greatest[i] = std::max(greatest[i], std::abs(values[i]) / limits[i]);
}

// Whether something behind the joint, and behind each that follows it, has mass.
bool moves_mass(const RobotModel& model, int joint) {
  for (std::size_t of = 0; of < model.joints.size(); ++of) {
    if (static_cast<int>(of) != joint && model.joints[of].mimic != joint) continue;
    std::vector<bool> behind(model.links.size(), false);
    bool any = false;
    for (std::size_t i = 0; i < model.joints.size(); ++i) {  // parents before children
      const auto child = static_cast<std::size_t>(model.joints[i].child);
      behind[child] = i == of || behind[static_cast<std::size_t>(model.joints[i].parent)];
      any |= behind[child] && model.links[child].inertial.has_value();
    }
    if (!any) return false;
  }
  return true;
}

// How the body stands under these torques.
void stand(const Body& body, const Motion& motion, const Eigen::VectorXd& torques, const Support& support,
           Replay& result) {
  const Equations& equations = motion.equations();
  const Wrench reaction = body.reaction(motion.joints(), motion.speeds(),
                                        equations.mass.llt().solve(torques - equations.bias), kGravity);
  result.margin = std::min(result.margin, support.margin(reaction));
  result.grip = std::max(result.grip, needed_grip(reaction));
}

constexpr double per_second(double hz) { return 2 * std::numbers::pi * hz; }

// What the servos of the joints that draw want of their motors.
Eigen::VectorXd wanted_accelerations(const Motors& motors, const JointPath::Point& wanted, double hz) {
  const double w = per_second(hz);
  return wanted.acceleration + 2 * w * (wanted.velocity - motors.speeds()) +
         w * w * (wanted.position - motors.positions());
}

// Computed torques of the joints that draw.
void command_torques(const Motion& motion, const Eigen::VectorXd& acceleration,
                     const std::vector<int>& drawing, Eigen::VectorXd& torques) {
  for (const int i : drawing) {
    torques[i] = motion.equations().bias[i];
    for (const int k : drawing) torques[i] += motion.equations().mass(i, k) * acceleration[k];
  }
}

// The servos of the joints that hold.
Springs holding_springs(const Motion& motion, const std::vector<int>& drawing, double hz) {
  const double w = per_second(hz);
  const Eigen::ArrayXd inertia = motion.equations().mass.diagonal();
  Springs springs{w * w * inertia, 2 * w * inertia, motion.joints()};
  for (const int i : drawing) springs.stiffness[i] = springs.damping[i] = 0;
  return springs;
}

// What the servos give during a step of what the controller and the springs ask for together. Where a spring
// would go beyond a limit, the limit takes its place.
Eigen::VectorXd given_torques(const Motion& motion, const Eigen::VectorXd& asked, Eigen::VectorXd torques,
                              Springs springs, const ServoLimits& limits, double seconds) {
  bool beyond = false;
  for (Eigen::Index i = 0; i < torques.size(); ++i) {
    double given = asked[i];
    if (limits.torque[i] > 0) given = std::clamp(given, -limits.torque[i], limits.torque[i]);
    const double speed = motion.speeds()[i];
    if (limits.speed[i] > 0 && std::abs(speed) >= limits.speed[i] && given * speed > 0) given = 0;
    if (given == asked[i]) continue;
    beyond = true;
    torques[i] = given;
    springs.stiffness[i] = springs.damping[i] = 0;
  }
  return beyond ? Eigen::VectorXd(torques + motion.spring_torques(springs, torques, seconds)) : asked;
}

}  // namespace

ServoLimits servo_limits(const Body& body) {
  ServoLimits limits{Eigen::VectorXd(body.dof()), Eigen::VectorXd(body.dof())};
  for (Eigen::Index i = 0; i < body.dof(); ++i) {
    const Joint& joint =
        body.model()
            .joints[static_cast<std::size_t>(body.model().joint(body.moving()[static_cast<std::size_t>(i)]))];
    limits.torque[i] = joint.effort;
    limits.speed[i] = joint.velocity;
  }
  return limits;
}

Replay replay(const Body& body, int tip, const JointPath& path, const std::vector<int>& drawing,
              const Eigen::VectorXd& posture, const ServoSettings& settings, const Mechanics& mechanics) {
  HBR_CHECK(static_cast<Eigen::Index>(drawing.size()) == path.dof() && posture.size() == body.dof(),
            "drawing {}, path {}, posture {}, body {}", drawing.size(), path.dof(), posture.size(),
            body.dof());
  const Eigen::Index dof = body.dof();
  const ServoLimits limits = servo_limits(body);
  const Gears& gears = mechanics.gears;
  const Eigen::VectorXd start = in_body(path.at(0), drawing, posture).position;
  Equations held;
  body.equations(start, Eigen::VectorXd::Zero(dof), kGravity, held);
  Motion motion(body, Motors::joints_under(gears, start, held.bias), Eigen::VectorXd::Zero(dof));
  Motors motors(gears, motion.joints(), held.bias);
  Replay result{{}, {}, Eigen::VectorXd::Zero(dof), Eigen::VectorXd::Zero(dof)};
  const Springs springs = holding_springs(motion, drawing, settings.holding_hz);
  Eigen::VectorXd torques = motion.equations().bias;  // the weight; those of joints that draw change below

  const double period = settings.step * settings.control_every;
  const auto commands = static_cast<int>(std::ceil(path.duration() / period));
  for (int command = 0; command <= commands; ++command) {
    const JointPath::Point wanted = in_body(path.at(command * period), drawing, posture);
    result.wanted.push_back(body.position(tip, wanted.position.data()));
    result.tip.push_back(body.position(tip, motion.joints().data()));
    const Eigen::VectorXd accelerations = wanted_accelerations(motors, wanted, settings.drawing_hz);
    command_torques(motion, accelerations, drawing, torques);
    if (!torques.allFinite())
      throw InputError("{}: the movement is unstable; expected a smaller step or softer servos",
                       body.model().path.string());
    for (int step = 0; step < settings.control_every; ++step) {
      const Eigen::VectorXd asked = torques + motion.spring_torques(springs, torques, settings.step);
      raise(result.torque, asked, limits.torque);
      raise(result.speed, motion.speeds(), limits.speed);
      const Eigen::VectorXd given = given_torques(motion, asked, torques, springs, limits, settings.step);
      Eigen::VectorXd driven = motors.handed_on(given);
      if (gears.rub()) driven += friction_torques(gears, motion, driven, settings.step);
      if (mechanics.support && step == 0) stand(body, motion, driven, *mechanics.support, result);
      motion.step(driven, settings.step);
      motors.follow(motion, given, accelerations, settings.step);
    }
  }
  return result;
}

Fastest fastest(const Body& body, const JointPath& path, const std::vector<int>& drawing,
                const Eigen::VectorXd& posture, double every) {
  const ServoLimits limits = servo_limits(body);
  Fastest result{kFastest, -1, false};
  const auto lower = [&](double factor, Eigen::Index joint, bool by_torque) {
    if (factor < result.factor) result = {factor, static_cast<int>(joint), by_torque};
  };
  Equations moving, still;
  const auto points = static_cast<int>(std::ceil(path.duration() / every));
  for (int point = 0; point <= points; ++point) {
    const JointPath::Point at = in_body(path.at(point * every), drawing, posture);
    body.equations(at.position, at.velocity, kGravity, moving);
    body.equations(at.position, Eigen::VectorXd::Zero(body.dof()), kGravity, still);
    // At a factor p speeds grow by p, accelerations and the forces of speeds by p^2.
    const Eigen::VectorXd by_square = moving.mass * at.acceleration + moving.bias - still.bias;
    for (Eigen::Index i = 0; i < body.dof(); ++i) {
      if (limits.speed[i] > 0 && at.velocity[i] != 0)
        lower(limits.speed[i] / std::abs(at.velocity[i]), i, false);
      if (limits.torque[i] > 0) {
        const double towards = by_square[i] < 0 ? -1 : 1, spare = limits.torque[i] - towards * still.bias[i];
        if (std::abs(still.bias[i]) > limits.torque[i]) lower(0, i, true);
        if (by_square[i] != 0) lower(std::sqrt(std::max(0.0, spare / std::abs(by_square[i]))), i, true);
      }
    }
  }
  return result;
}

std::vector<std::string> joints_with_inertia(const RobotModel& model,
                                             const std::map<std::string, double>& rest, double least) {
  std::vector<std::string> result;
  Equations equations;
  for (const std::string& name : model.independent_joints()) {
    if (!moves_mass(model, model.joint(name))) continue;
    const Body alone(model, {name}, rest);
    alone.equations(alone.posture(rest), Eigen::VectorXd::Zero(1), Eigen::Vector3d::Zero(), equations);
    if (equations.mass(0, 0) >= least) result.push_back(name);
  }
  return result;
}

}  // namespace hbr::inline robots
