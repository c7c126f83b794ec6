#include "models/robot/looks/visible_links.h"

#include <fmt/format.h>

#include <algorithm>

#include "models/robot/description/find_mesh.h"
#include "models/robot/looks/shapes.h"
#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

// From a link's frame to those of its children.
std::vector<Mesh> rods(const RobotModel& model, int link, double radius) {
  std::vector<Mesh> result{ellipsoid(Eigen::Vector3d::Constant(1.6 * radius))};
  for (const Joint& joint : model.joints)
    if (joint.parent == link && joint.origin.translation().norm() > radius)
      result.push_back(rod(Eigen::Vector3d::Zero(), joint.origin.translation(), radius));
  return result;
}

}  // namespace

std::vector<std::vector<Mesh>> visible_links(const RobotModel& model, const std::filesystem::path& folder,
                                             double scale, std::vector<std::string>& odd) {
  std::vector<std::vector<Mesh>> meshes(model.links.size());
  std::vector<bool> lost(model.links.size());
  bool any = false;
  int failed = 0, elsewhere = 0;
  std::string first_elsewhere;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    try {
      meshes[i] = visual_meshes(model, model.links[i], folder, scale);
    } catch (const InputError& error) {
      lost[i] = true;
      if (++failed == 1) odd.push_back(fmt::format("{}; drawn as rods", error.what()));
      continue;
    }
    for (const Visual& visual : model.links[i].visuals) {
      if (visual.kind != Visual::Kind::mesh) continue;
      const FoundMesh found = find_mesh(visual.mesh, model.path, folder);
      if (found.elsewhere && ++elsewhere == 1)
        first_elsewhere = fmt::format("mesh '{}' is not where its name says: taken from {}", visual.mesh,
                                      found.path.string());
    }
    any = any || !meshes[i].empty();
  }
  if (elsewhere)
    odd.push_back(first_elsewhere + (elsewhere > 1 ? fmt::format(" (and {} more)", elsewhere - 1) : ""));
  if (failed > 1) odd.push_back(fmt::format("{} more links whose meshes can't be had", failed - 1));
  if (!any) odd.emplace_back("no link shows anything: drawn as rods between the joints");
  double length = 0;
  for (const Joint& joint : model.joints) length = std::max(length, joint.origin.translation().norm());
  const double radius = length > 0 ? 0.06 * length : 0.05;
  for (std::size_t i = 0; i < model.links.size(); ++i)
    if (!any || lost[i]) meshes[i] = rods(model, static_cast<int>(i), radius);
  return meshes;
}

}  // namespace hbr::inline robots
