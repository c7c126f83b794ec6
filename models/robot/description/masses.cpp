#include "models/robot/description/masses.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>

#include "models/robot/description/parts.h"

namespace hbr::inline robots {
namespace {

using Kind = MassFault::Kind;
using Solver = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>;

// "'a', 'b', 'c' and 4 more"
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 3;
  std::string text;
  for (std::size_t i = 0; i < std::min(kShown, names.size()); ++i)
    text += fmt::format("{}'{}'", i ? ", " : "", names[i]);
  return names.size() > kShown ? fmt::format("{} and {} more", text, names.size() - kShown) : text;
}

MassFault fault_of(const Link& link) {
  if (link.weightless_inertia) return {Kind::not_positive};
  if (!link.inertial) return {};
  return mass_fault(link.inertial->mass, link.inertial->centre, link.inertial->inertia);
}

}  // namespace

MassFault mass_fault(double mass, const Eigen::Vector3d& centre, const Eigen::Matrix3d& inertia) {
  if (!(mass > 0)) return {Kind::not_positive, fmt::format("the mass is {} kg; expected more than 0", mass)};
  const Eigen::Vector3d moments = Solver(inertia).eigenvalues();
  const std::string shown = fmt::format("principal moments of inertia {:.4g}, {:.4g}, {:.4g} kg m^2",
                                        moments[0], moments[1], moments[2]);
  if (!(moments[0] > 1e-12 * (moments[2] + mass * centre.squaredNorm())))
    return {Kind::not_positive, shown + "; expected all above 0"};
  const double excess = moments[2] / (moments[0] + moments[1]) - 1;
  if (excess <= 1e-9) return {};
  return {excess <= 0.01 ? Kind::rounded : Kind::lopsided,
          shown + ": no body has one larger than the sum of the other two"};
}

Eigen::Matrix3d nearest_possible(const Eigen::Matrix3d& inertia) {
  const Solver solver(inertia);
  Eigen::Vector3d moments = solver.eigenvalues().cwiseMax(0);
  moments[2] = std::min(moments[2], moments[0] + moments[1]);
  return solver.eigenvectors() * moments.asDiagonal() * solver.eigenvectors().transpose();
}

std::vector<std::string> mass_oddities(const RobotModel& model) {
  const Parts parts = join_parts(model, model.independent_joints(), {});
  std::vector<std::string> made_up, rounded, lopsided, odd;
  std::string first_rounded, first_lopsided;
  for (std::size_t i = 0; i < model.links.size(); ++i)
    if (fault_of(model.links[i]).kind != Kind::none &&
        parts.parts[parts.places[i].part].fault.kind == Kind::none)
      made_up.push_back(model.links[i].name);
  for (std::size_t p = 0; p < parts.parts.size(); ++p) {
    const Part& part = parts.parts[p];
    const std::string& name = model.links[part.joint < 0 ? 0 : model.joints[part.joint].child].name;
    if (part.fault.kind == Kind::rounded) {
      if (rounded.empty()) first_rounded = part.fault.why;
      rounded.push_back(name);
    } else if (part.fault.kind != Kind::none && (p > 0 || part.mass > 0)) {
      if (lopsided.empty()) first_lopsided = part.fault.why;
      lopsided.push_back(name);
    }
  }
  if (!made_up.empty())
    odd.push_back(fmt::format(
        "links {}: mass or inertia that no body has; with what is fixed to them it can be", listed(made_up)));
  if (!rounded.empty())
    odd.push_back(
        fmt::format("links {}: {}, by at most 1 %: taken as rounding", listed(rounded), first_rounded));
  if (!lopsided.empty())
    odd.push_back(fmt::format("links {}: {}; they can draw, but their dynamics are refused", listed(lopsided),
                              first_lopsided));
  return odd;
}

}  // namespace hbr::inline robots
