// A robot at its board for a viewer in three dimensions: rigid parts, joints, surfaces of few triangles.
#include "models/robot/looks/mesh_file.h"
#include "models/robot/plane/planar_body.h"
#include "models/robot/plane/plane_file.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/core/check.h"
#include "pipeline/hierarchy/drawing_settings.h"
#include "stages/layers/body.h"
#include "stages/robots/robot_links.h"
#include "stages/robots/robot_tasks.h"
#include "stages/robots/shape_file.h"

namespace hbr::inline stages {
namespace {

struct ShapeStage {
  double half_side = 0;
  RobotShapeTable shape;
  nlohmann::json body;
};
template <class Fields>
void describe(Fields& f, ShapeStage& s) {
  describe_half_side(f, s.half_side);
  f.table("shape", s.shape, "how exact it is");
  f.raw_table("body", s.body, "the robot, or the arm");
}

struct Shown {
  RobotOnPlane robot;
  std::vector<std::vector<Mesh>> meshes;
};
Shown shown(const StageRun& stage, const nlohmann::json& body) {
  if (body.contains("arm")) {
    const auto arm = settings_from_json<ArmTable>(body["arm"], stage.name() + ": body.arm");
    RobotOnPlane robot = planar_body(arm.links, arm.joint_limit);
    auto meshes = link_meshes(robot.body().model(), "", 1);
    return {std::move(robot), std::move(meshes)};
  }
  if (!body.contains("robot"))
    throw InputError("{}: body is neither an arm nor a robot; expected one of the two", stage.name());
  const auto table = settings_from_json<RobotSettings>(body["robot"], stage.name() + ": body.robot");
  RobotOnPlane robot = make_robot(table, load_plane(stage.input("plane")));
  auto meshes = robot_links(stage, robot.body().model(), table);
  return {std::move(robot), std::move(meshes)};
}

void run(StageRun& stage) {
  const auto settings = stage.settings_as<ShapeStage>();
  const Shown of = shown(stage, settings.body);
  const RobotOnPlane& robot = of.robot;
  Workers workers(stage.threads());
  const RobotShape shape =
      shape_of(robot.body(), of.meshes, static_cast<std::size_t>(settings.shape.triangles),
               settings.shape.deviation, workers);
  const Parts::Place pen = robot.body().moving_parts().places[static_cast<std::size_t>(robot.tip())];
  const DrawingPlane& plane = robot.plane();

  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  const auto write = [&](const std::string& name, const auto& values) {
    file.write(name, std::vector<double>(values.begin(), values.end()));
  };
  write_shape(file, robot.body(), shape);
  file.attribute("pen_part", static_cast<std::int64_t>(pen.part));
  write("pen/place", Eigen::Vector3d(pen.pose.translation()));
  write("plane/origin", plane.origin);
  write("plane/u", plane.u);
  write("plane/v", plane.v);
  file.attribute("plane_scale", plane.scale);
  file.attribute("half_side", settings.half_side);
  file.close();
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "A robot's parts, joints and surfaces for a viewer", hbr::run);
}
