// robot URDF OUT [FOLDER OF MESHES [JOINT=POSITION...]]: what a robot is, as a table and a picture. No stage:
// it belongs to no experiment.
#include <cmath>
#include <cstdio>
#include <limits>

#include "models/robot/body/body.h"
#include "models/robot/body/robot_facts.h"
#include "models/robot/looks/render.h"
#include "models/robot/looks/visible_links.h"
#include "pipeline/artifact/program.h"
#include "pipeline/core/check.h"

namespace {

using namespace hbr;

// "JOINT=POSITION"
std::pair<std::string, double> placed(const std::string& word) {
  const std::size_t at = word.find('=');
  char* end = nullptr;
  const double position = at == std::string::npos ? NAN : std::strtod(word.c_str() + at + 1, &end);
  if (!std::isfinite(position) || *end || end == word.c_str() + at + 1)
    throw InputError("'{}': expected JOINT=POSITION, in rad or m", word);
  return {word.substr(0, at), position};
}

// Poses beyond a joint's limits, which it is shown at; what turns without end is brought into one turn.
void keep_within_limits(const RobotModel& model, std::map<std::string, double>& pose,
                        std::vector<std::string>& odd) {
  for (auto& [name, position] : pose) {
    const Joint& joint = model.joints[static_cast<std::size_t>(model.joint(name))];
    if (joint.kind == Joint::Kind::continuous) position = std::remainder(position, 2 * M_PI);
    if (position < joint.lower || position > joint.upper)
      odd.push_back(
          fmt::format("joint '{}' can't stand at {}: it moves in [{:.3f}, {:.3f}] and is shown at its limit",
                      name, position, joint.lower, joint.upper));
  }
}

Eigen::AlignedBox3d box_of(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const Posed& body : scene.bodies)
    for (const Mesh& mesh : body.meshes)
      for (const Eigen::Vector3f& vertex : mesh.vertices) box.extend(body.pose * vertex.cast<double>());
  return box;
}

void describe(const std::filesystem::path& urdf, const std::filesystem::path& out,
              const std::filesystem::path& folder, std::map<std::string, double> pose) {
  const RobotModel model = load_urdf(urdf);
  std::vector<std::string> odd;
  keep_within_limits(model, pose, odd);
  const auto meshes = visible_links(model, folder, 1, odd);
  const Body body(model, {}, pose);  // stands as it was told
  const auto frames = body.link_poses(Eigen::VectorXd());
  Scene scene;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (!meshes[i].empty()) scene.bodies.push_back({model.links[i].name, meshes[i], frames[i]});
  const Eigen::AlignedBox3d box = box_of(scene);
  scene.floor = box.min()[2];
  const Eigen::Vector3d size = box.sizes();

  fmt::print("{}: {} links, {} joints, of which {} move by themselves\n\n{}\n", model.name,
             model.links.size(), model.joints.size(), model.independent_joints().size(), joint_table(model));
  fmt::print("limits in rad or m, velocity in rad/s or m/s, effort in N m or N\n\nmass    {:.4f} kg\n",
             body.mass());
  fmt::print("height  {:.3f} m as it stands ({:.3f} m deep, {:.3f} m wide)\n", size[2], size[0], size[1]);
  for (const ChainReach& reach : chain_reaches(model))
    fmt::print("reach   {:.3f} m from joint '{}' to '{}'\n", reach.metres, reach.joint, reach.link);
  for (const std::string& line : oddities(model, size.norm())) odd.push_back(line);
  for (const std::string& line : odd) fmt::print("odd: {}\n", line);

  std::error_code failed;
  std::filesystem::create_directories(out, failed);
  if (failed) throw InputError("{}: can't be made: {}", out.string(), failed.message());
  const std::string stem = (out / urdf.stem()).string();
  const Camera camera = camera_for(scene, Eigen::Vector3d(-1, 0.6, -0.25), 0.42, 4. / 5);
  write_png(stem + ".png", render(scene, camera, 800, 1000));
  save_scene(stem + ".glb", "glb2", scene.bodies);
  fmt::print("{0}.png, {0}.glb\n", stem);
}

}  // namespace

int main(int argc, char** argv) {
  return hbr::guarded_main("robot", [&] {
    if (argc < 3 || !*argv[1])
      throw InputError(
          "expected a URDF and a folder: make robot URDF=path [MESHES=folder] [POSE=\"JOINT=rad ...\"]");
    std::map<std::string, double> pose;
    for (int i = 4; i < argc; ++i)
      if (!pose.insert(placed(argv[i])).second) throw InputError("'{}': its joint is given twice", argv[i]);
    describe(argv[1], argv[2], argc > 3 ? argv[3] : "", pose);
    return 0;
  });
}
