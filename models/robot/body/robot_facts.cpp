#include "models/robot/body/robot_facts.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "models/robot/description/masses.h"

namespace hbr::inline robots {
namespace {

const char* word(Joint::Kind kind) {
  constexpr const char* kWords[] = {"fixed", "revolute", "continuous", "prismatic"};
  return kWords[static_cast<int>(kind)];
}

std::string limit_or_none(double limit) { return limit == 0 ? "none" : fmt::format("{:.3g}", limit); }

using Row = std::array<std::string, 9>;

Row row_of(const RobotModel& model, const Joint& joint) {
  Row row{joint.name, word(joint.kind),
          model.links[joint.parent].name + " -> " + model.links[joint.child].name};
  if (joint.kind == Joint::Kind::fixed) return row;
  row[3] = fmt::format("{:.3g} {:.3g} {:.3g}", joint.axis[0], joint.axis[1], joint.axis[2]);
  row[4] = fmt::format("{:.3f}", joint.lower);
  row[5] = fmt::format("{:.3f}", joint.upper);
  row[6] = limit_or_none(joint.velocity);
  row[7] = limit_or_none(joint.effort);
  if (joint.mimic >= 0)
    row[8] =
        fmt::format("{:.3g} * {} + {:.3g}", joint.multiplier, model.joints[joint.mimic].name, joint.offset);
  return row;
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
    if (joint.kind == Joint::Kind::revolute && joint.upper - joint.lower > 8 * std::numbers::pi)
      add("joint '{}' turns by {:.1f} rad, {:.0f} times around: are its limits degrees?", joint.name,
          joint.upper - joint.lower, (joint.upper - joint.lower) / (2 * std::numbers::pi));
    if (joint.mimic < 0) continue;
    const Joint& leader = model.joints[joint.mimic];
    const auto [low, high] = std::minmax(
        {joint.multiplier * leader.lower + joint.offset, joint.multiplier * leader.upper + joint.offset});
    const auto [from, to] = model.range(joint.mimic);
    if (low < joint.lower - 1e-3 || high > joint.upper + 1e-3)
      add("joint '{}' follows '{}' to [{:.3f}, {:.3f}], beyond its own limits [{:.3f}, {:.3f}]: "
          "'{}' moves in [{:.3f}, {:.3f}]",
          joint.name, leader.name, low, high, joint.lower, joint.upper, leader.name, from, to);
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
  return odd;
}

}  // namespace hbr::inline robots
