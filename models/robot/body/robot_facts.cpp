#include "models/robot/body/robot_facts.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "models/robot/body/body.h"
#include "models/robot/description/masses.h"
#include "pipeline/core/check.h"
#include "pipeline/core/random.h"

namespace hbr {
namespace {

const char* word(Joint::Kind kind) {
  constexpr const char* kWords[] = {"fixed", "revolute", "continuous", "prismatic"};
  return kWords[static_cast<int>(kind)];
}

using Row = std::array<std::string, 9>;

Row row_of(const RobotModel& model, const Joint& joint) {
  Row row{joint.name, word(joint.kind),
          model.links[joint.parent].name + " -> " + model.links[joint.child].name};
  if (joint.kind == Joint::Kind::fixed) return row;
  row[3] = fmt::format("{:.3g} {:.3g} {:.3g}", joint.axis[0], joint.axis[1], joint.axis[2]);
  row[4] = fmt::format("{:.3f}", joint.lower);
  row[5] = fmt::format("{:.3f}", joint.upper);
  row[6] = fmt::format("{:.3g}", joint.velocity);
  row[7] = fmt::format("{:.3g}", joint.effort);
  if (joint.mimic >= 0)
    row[8] =
        fmt::format("{:.3g} * {} + {:.3g}", joint.multiplier, model.joints[joint.mimic].name, joint.offset);
  return row;
}

// Positions of joints that move by themselves -> of every joint.
double position(const RobotModel& model, int joint, const std::vector<double>& positions) {
  const Joint& j = model.joints[joint];
  return j.mimic < 0 ? positions[joint] : j.multiplier * positions[j.mimic] + j.offset;
}

// The joints from the root to a link.
std::vector<int> chain_to(const RobotModel& model, int link) {
  std::vector<int> joints;
  for (int at = link; model.links[at].joint >= 0; at = model.joints[model.links[at].joint].parent)
    joints.insert(joints.begin(), model.links[at].joint);
  return joints;
}

// The greatest value of `of` within the joints' limits: from the best of some samples, steps along the joints
// that shrink where none is better any more; several times over.
double highest(const RobotModel& model, const std::vector<int>& joints, Seed seed,
               const std::function<double(const std::vector<double>&)>& of) {
  Rng rng(seed);
  double found = 0;
  for (int start = 0; start < 6; ++start) {
    std::vector<double> best(model.joints.size());
    double highest = -1;
    const auto attempt = [&](const std::vector<double>& at) {
      const double value = of(at);
      if (!(value > highest)) return false;
      highest = value;
      best = at;
      return true;
    };
    for (int i = 0; i < 500; ++i) {
      std::vector<double> at(model.joints.size());
      for (const int j : joints)
        at[j] = std::lerp(model.joints[j].lower, model.joints[j].upper, rng.uniform_double());
      attempt(at);
    }
    for (double share = 0.25; share > 1e-7; share /= 2)
      for (int round = 0; round < 50; ++round) {
        bool better = false;
        for (const int j : joints)
          for (const double sign : {-1., 1.}) {
            const Joint& joint = model.joints[j];
            std::vector<double> at = best;
            at[j] = std::clamp(at[j] + sign * share * (joint.upper - joint.lower), joint.lower, joint.upper);
            better = attempt(at) || better;
          }
        if (!better) break;
      }
    found = std::max(found, highest);
  }
  return found;
}

}  // namespace

std::string joint_table(const RobotModel& model) {
  std::vector<Row> rows{
      {"joint", "type", "parent -> child", "axis", "lower", "upper", "velocity", "effort", "follows"}};
  for (const Joint& joint : model.joints) rows.push_back(row_of(model, joint));
  std::array<std::size_t, 9> widths{};
  for (const Row& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  std::string table;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t k = 0; k < row.size(); ++k)
      line += k >= 4 && k <= 7 ? fmt::format("{:>{}}  ", row[k], widths[k])
                               : fmt::format("{:<{}}  ", row[k], widths[k]);
    table += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return table;
}

std::vector<ChainReach> chain_reaches(const RobotModel& model) {
  std::vector<bool> has_child(model.links.size());
  for (const Joint& joint : model.joints) has_child[joint.parent] = true;
  std::vector<ChainReach> result;
  for (int link = 0; link < static_cast<int>(model.links.size()); ++link) {
    std::vector<int> chain = chain_to(model, link);
    const auto first =
        std::ranges::find_if(chain, [&](int j) { return model.joints[j].kind != Joint::Kind::fixed; });
    if (has_child[link] || first == chain.end()) continue;
    chain.erase(chain.begin(), first);
    std::vector<int> free;
    for (const int j : chain) {
      const Joint& joint = model.joints[j];
      const int mover = joint.mimic < 0 ? j : joint.mimic;
      if (joint.kind != Joint::Kind::fixed && std::ranges::find(free, mover) == free.end())
        free.push_back(mover);
    }
    const auto distance = [&](const std::vector<double>& positions) {
      Eigen::Vector3d tip = Eigen::Vector3d::Zero();
      for (std::size_t k = chain.size(); k-- > 0;)
        tip = model.joints[chain[k]].motion(position(model, chain[k], positions)) * tip;
      return (tip - model.joints[chain[0]].origin.translation()).norm();
    };
    result.push_back({model.links[link].name, model.joints[chain[0]].name,
                      highest(model, free, Seed(1).child(model.links[link].name), distance)});
  }
  return result;
}

std::vector<std::string> oddities(const RobotModel& model, double size) {
  std::vector<std::string> odd;
  const auto add = [&odd]<class... Args>(fmt::format_string<Args...> text, Args&&... args) {
    odd.push_back(fmt::format(text, std::forward<Args>(args)...));
  };
  for (const Joint& joint : model.joints) {
    if (joint.kind == Joint::Kind::fixed) continue;
    if (joint.lower == joint.upper)
      add("joint '{}' can't move: both limits are {}", joint.name, joint.lower);
    else if (joint.mimic < 0 && (joint.lower > 0 || joint.upper < 0))
      add("joint '{}' can't stand at 0: it moves in [{:.3f}, {:.3f}]", joint.name, joint.lower, joint.upper);
    if (joint.kind == Joint::Kind::revolute && joint.upper - joint.lower > 2 * std::numbers::pi + 1e-3)
      add("joint '{}' turns by {:.1f} rad, more than once around: are its limits degrees?", joint.name,
          joint.upper - joint.lower);
    if (joint.kind != Joint::Kind::continuous || joint.velocity > 0 || joint.effort > 0) {
      if (joint.velocity == 0) add("joint '{}' has velocity 0", joint.name);
      if (joint.effort == 0) add("joint '{}' has effort 0", joint.name);
    }
    if (joint.mimic < 0) continue;
    const Joint& leader = model.joints[joint.mimic];
    const auto [low, high] = std::minmax(
        {joint.multiplier * leader.lower + joint.offset, joint.multiplier * leader.upper + joint.offset});
    if (low < joint.lower - 1e-3 || high > joint.upper + 1e-3)
      add("joint '{}' follows '{}' to [{:.3f}, {:.3f}], beyond its own limits [{:.3f}, {:.3f}]", joint.name,
          leader.name, low, high, joint.lower, joint.upper);
  }
  for (const Link& link : model.links) {
    if (!link.inertial) continue;
    const Eigen::Vector3d moments =
        Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(link.inertial->inertia).eigenvalues();
    const double gyration = std::sqrt(moments[2] / link.inertial->mass);
    if (gyration > size || (gyration > 0 && gyration < 1e-3 * size))
      add("link '{}': {:.3g} kg with the inertia of a body of about {:.2g} m", link.name, link.inertial->mass,
          2 * gyration);
    if (link.inertial->centre.norm() > size)
      add("link '{}': its centre of mass is {:.3g} m from its frame", link.name,
          link.inertial->centre.norm());
  }
  if (size > 20) add("it is {:.3g} m large: are its lengths or meshes in millimetres?", size);
  if (size < 0.02) add("it is {:.3g} m large: are its meshes in metres already?", size);
  for (const std::string& line : mass_oddities(model)) odd.push_back(line);
  try {
    Body(model, model.independent_joints());
  } catch (const InputError& error) {
    odd.emplace_back(error.what());
  }
  return odd;
}

}  // namespace hbr
