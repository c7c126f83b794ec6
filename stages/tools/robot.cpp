// robot URDF OUT [FOLDER OF MESHES [JOINT=POSITION...]]: what a robot is, as a table, pictures and a page on
// which it turns. No stage: it belongs to no experiment.
#include <cmath>
#include <cstdio>
#include <limits>

#include "models/nao/nao_meshes.h"
#include "models/robot/body/body.h"
#include "models/robot/body/chain.h"
#include "models/robot/body/robot_facts.h"
#include "models/robot/description/find_mesh.h"
#include "models/robot/looks/boards.h"
#include "models/robot/looks/reach_cloud.h"
#include "models/robot/looks/render.h"
#include "models/robot/looks/robot_shape.h"
#include "models/robot/looks/visible_links.h"
#include "models/robot/plane/best_boards.h"
#include "pipeline/artifact/content.h"
#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/program.h"
#include "pipeline/artifact/temporary.h"
#include "pipeline/core/check.h"
#include "pipeline/core/file_error.h"
#include "reports/page/robot_page.h"
#include "stages/robots/shape_file.h"

namespace {

using namespace hbr;

// Says something on the terminal, and keeps it for the page.
class Teller {
 public:
  template <class... Args>
  void operator()(fmt::format_string<Args...> words, Args&&... args) {
    const std::string text = fmt::format(words, std::forward<Args>(args)...);
    fmt::print("{}", text);
    std::fflush(stdout);
    told_ += text;
  }
  const std::string& told() const { return told_; }

 private:
  std::string told_;
};

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
    const int index = model.joint(name);
    const Joint& joint = model.joints[index];
    if (joint.kind == Joint::Kind::fixed)
      throw InputError("POSE: joint '{}' is fixed; expected one that moves", name);
    if (joint.mimic >= 0)
      throw InputError("POSE: joint '{}' follows joint '{}'; expected that one", name,
                       model.joints[joint.mimic].name);
    position = joint.within_a_turn(position);
    const auto [lower, upper] = model.range(index);
    if (position < lower || position > upper)
      odd.push_back(
          fmt::format("joint '{}' can't stand at {}: it moves in [{:.3f}, {:.3f}] and is shown at its limit",
                      name, position, lower, upper));
  }
}

void make_folder(const std::filesystem::path& out) {
  std::error_code failed;
  std::filesystem::create_directories(out, failed);
  if (failed) throw file_error(out, "can't make this folder", failed.value());
}

Camera view_of(const Scene& scene) {
  return camera_for(scene, Eigen::Vector3d(-1, 0.6, -0.25), 0.42, 4. / 5);
}

Eigen::AlignedBox3d box_of(const Scene& scene) {
  Eigen::AlignedBox3d box;
  for (const Posed& body : scene.bodies)
    for (const Mesh& mesh : body.meshes)
      for (const Eigen::Vector3f& vertex : mesh.vertices) box.extend(body.pose * vertex.cast<double>());
  return box;
}

// Throws where one of the files that are written is one that the robot is read from.
void keep_what_is_read(const RobotModel& model, const std::filesystem::path& folder,
                       const std::vector<std::string>& written) {
  std::vector<std::filesystem::path> read = mesh_files(model, folder);
  read.push_back(model.path);
  std::error_code not_there;
  for (const std::string& file : written)
    for (const std::filesystem::path& other : read)
      if (std::filesystem::equivalent(file, other, not_there))
        throw InputError("{} is a file of the robot, and would be overwritten; give another folder as OUT",
                         file);
}

// The folder of the meshes: as given; NAO's are no files of the project, they are made.
std::filesystem::path meshes_in(const std::filesystem::path& given, const std::filesystem::path& urdf,
                                const std::filesystem::path& out) {
  std::error_code ignored;
  if (!given.empty() || !std::filesystem::equivalent(urdf, "models/nao/nao.urdf", ignored)) return given;
  write_nao_meshes(out / "nao_meshes");
  return out / "nao_meshes";
}

// A second picture: the robot in what its chains reach.
void draw_reach(Scene scene, const std::vector<Chain>& chains, const std::string& file) {
  constexpr double kPostures = 3e4, kSteps = 3e6;  // of all chains
  Scene solid = scene;                             // a camera looks at nothing that is seen through
  Eigen::AlignedBox3d box = box_of(scene);
  for (const Chain& chain : chains)
    for (const Eigen::Vector3d& point : reached_points(chain, 100)) box.extend(point);
  for (const Chain& chain : chains) {
    const double share = 1. / static_cast<double>(chains.size()),
                 most = std::min(kPostures, kSteps / static_cast<double>(chain.steps.size()));
    scene.bodies.push_back(reach_cloud(chain, static_cast<int>(std::ceil(most * share)), box.sizes().norm()));
    solid.bodies.push_back(scene.bodies.back());
    for (Mesh& mesh : solid.bodies.back().meshes) mesh.opacity = 1;
  }
  write_png(file, render(scene, view_of(solid), 800, 1000));
}

// The largest boards of each kind, as a line for each chain; of the chain with the largest a third picture,
// in which a level board is blue, an upright one green and a leaning one orange. Whether there is any.
bool draw_boards(Scene scene, const RobotModel& model, const std::vector<Chain>& chains,
                 const std::map<std::string, double>& pose, const std::string& file, Teller& tell) {
  constexpr double kSamples = 200000;  // of all chains
  constexpr std::size_t kMostJoints = 12;
  const std::vector<Eigen::Vector3f> colours{{0, 0.45f, 0.7f}, {0, 0.6f, 0.45f}, {0.9f, 0.6f, 0}};
  std::vector<KindOfBoard> shown;
  double largest = 0;  // of the boards shown, half a side, m
  Workers workers(1);
  for (const Chain& chain : chains) {
    std::vector<std::string> joints;
    for (const Joint* joint : chain.leaders) joints.push_back(joint->name);
    if (joints.size() < 2 || joints.size() > kMostJoints) {
      tell("boards  of '{}': {}\n", chain.link,
           joints.size() < 2 ? "none, as a joint alone moves it along a curve"
                             : fmt::format("not looked for, as more than {} joints move it", kMostJoints));
      continue;
    }
    std::string line;
    double side = 0;
    std::vector<KindOfBoard> found;
    try {
      found = best_boards(model, joints, pose, model.link(chain.link),
                          static_cast<int>(kSamples / static_cast<double>(chains.size())), workers);
    } catch (const InputError& error) {
      tell("boards  of '{}': none, as {}\n", chain.link, error.what());
      continue;
    }
    for (const auto& [kind, board] : found) {
      const double own = board ? board->plane.scale : 0;
      line += fmt::format("{}{} {}", line.empty() ? "" : ", ", board_kind_name(kind),
                          board ? fmt::format("{:.3g} m", 2 * own) : "none");
      side = std::max(side, own);
    }
    tell("boards  of '{}', largest squares about: {}\n", chain.link, line);
    if (side > largest) shown = std::move(found);
    largest = std::max(largest, side);
  }
  for (std::size_t i = 0; i < shown.size(); ++i)
    if (shown[i].board)
      scene.bodies.push_back(framed_board(board_kind_name(shown[i].kind), *shown[i].board, colours[i]));
  if (largest > 0) write_png(file, render(scene, view_of(scene), 800, 1000));
  return largest > 0;
}

// The page on which its joints can be moved; the shape is a file for as long as that takes.
void write_page(const RobotModel& model, const std::map<std::string, double>& pose,
                const std::vector<std::vector<Mesh>>& meshes, const RobotPage& page,
                const std::string& file) {
  constexpr std::size_t kTriangles = 60000;
  constexpr double kDeviation = 5e-4;  // m
  const Body body(model, model.independent_joints(), pose);
  Workers workers(1);
  const Temporary shape(page.shape);
  Hdf5Writer writer(shape.path);
  write_shape(writer, body, shape_of(body, meshes, kTriangles, kDeviation, workers));
  writer.close();
  write_file(file, robot_page(page, ".cache/three"));
}

void describe(const std::filesystem::path& urdf, const std::filesystem::path& out,
              const std::filesystem::path& folder, std::map<std::string, double> pose) {
  Teller tell;
  const RobotModel model = load_urdf(urdf);
  std::vector<std::string> odd = model.odd;
  keep_within_limits(model, pose, odd);
  make_folder(out);
  const std::string stem = (out / urdf.stem()).string();
  const std::filesystem::path own = meshes_in(folder, urdf, out);
  keep_what_is_read(
      model, own, {stem + ".html", stem + ".glb", stem + ".png", stem + "_reach.png", stem + "_boards.png"});
  const auto meshes = visible_links(model, own, 1, odd);
  const Body body(model, {}, pose);  // stands as it was told
  const auto frames = body.link_poses(Eigen::VectorXd());
  Scene scene;
  for (std::size_t i = 0; i < meshes.size(); ++i)
    if (!meshes[i].empty()) scene.bodies.push_back({model.links[i].name, meshes[i], frames[i]});
  const Eigen::AlignedBox3d box = box_of(scene);
  scene.floor = box.min()[2];
  const Eigen::Vector3d size = box.sizes();

  tell("{}: links: {}, joints: {}, of them moving by themselves: {}\n\n{}\n", model.name, model.links.size(),
       model.joints.size(), model.independent_joints().size(), joint_table(model));
  tell("limits in rad or m, velocity in rad/s or m/s, effort in N m or N\n\nmass    {:.4f} kg\n",
       body.mass());
  tell("height  {:.3f} m as it stands ({:.3f} m deep, {:.3f} m wide)\n", size[2], size[0], size[1]);
  const std::vector<Chain> chains = chains_of(model);
  std::size_t steps = 1;
  for (const Chain& chain : chains) steps += chain.steps.size();
  const int starts = std::clamp(static_cast<int>(20000 / steps), 1, 30);
  for (const Chain& chain : chains)
    tell("reach   {:.3f} m from joint '{}' to '{}'\n", farthest_reach(chain, starts),
         chain.steps[0].joint->name, chain.link);
  for (const std::string& line : oddities(model, size.norm())) odd.push_back(line);
  for (const std::string& line : odd) tell("odd: {}\n", line);

  std::size_t triangles = 0;
  for (const auto& link : meshes)
    for (const Mesh& mesh : link) triangles += mesh.triangles.size();
  if (triangles > 2000000)
    fmt::print(stderr, "robot: draws {:.0f} million triangles\n", 1e-6 * static_cast<double>(triangles));
  const auto file = [&](const char* end) { return urdf.stem().string() + end; };
  write_png(stem + ".png", render(scene, view_of(scene), 800, 1000));
  save_scene(stem + ".glb", "glb2", scene.bodies);
  std::vector<RobotPage::Picture> pictures{{file(".png"), "As it stands."}};
  if (!chains.empty()) {
    draw_reach(scene, chains, stem + "_reach.png");
    pictures.push_back({file("_reach.png"), "What its chains reach: blue near their first joint, red far."});
    if (draw_boards(std::move(scene), model, chains, pose, stem + "_boards.png", tell))
      pictures.push_back(
          {file("_boards.png"), "The largest boards: level blue, upright green, leaning orange."});
  }
  write_page(model, pose, meshes, {model.name, stem + ".shape.h5", tell.told(), pictures}, stem + ".html");
  std::string made = fmt::format("{0}.html, {0}.glb", stem);
  for (const auto& picture : pictures) made += fmt::format(", {}", (out / picture.file).string());
  fmt::print("{}\n", made);
}

}  // namespace

int main(int argc, char** argv) {
  return hbr::guarded_main("robot", [&] {
    if (argc < 3 || !*argv[1])
      throw InputError(
          "no URDF is named; expected make robot URDF=arm.urdf [MESHES=folder] [POSE=\"JOINT=rad ...\"]");
    std::map<std::string, double> pose;
    for (int i = 4; i < argc; ++i)
      if (!pose.insert(placed(argv[i])).second) throw InputError("'{}': its joint is given twice", argv[i]);
    describe(argv[1], argv[2], argc > 3 ? argv[3] : "", pose);
    return 0;
  });
}
