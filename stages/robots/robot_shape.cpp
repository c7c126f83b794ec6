// A robot at its board for a viewer in three dimensions: rigid parts, joints, surfaces of few triangles.
#include "models/robot/looks/robot_shape.h"
#include <fmt/ranges.h>

#include "models/robot/looks/mesh_file.h"
#include "models/robot/plane/planar_body.h"
#include "models/robot/plane/plane_file.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/hierarchy/drawing_settings.h"
#include "stages/layers/body.h"
#include "stages/robots/robot_tasks.h"

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
  const auto table = settings_from_json<RobotSettings>(body.at("robot"), stage.name() + ": body.robot");
  RobotOnPlane robot = make_robot(table, load_plane(stage.input("plane")));
  const auto folder = stage.has_input("meshes") ? stage.input("meshes") : std::filesystem::path(table.meshes);
  auto meshes = link_meshes(robot.body().model(), folder, table.mesh_scale);
  return {std::move(robot), std::move(meshes)};
}

// Columns of an array with a row for each of some things.
template <class T>
class Table {
 public:
  explicit Table(std::size_t columns) : columns_(columns) {}
  template <class Row>
  void add(const Row& row) {
    for (const auto& value : row) values_.push_back(static_cast<T>(value));
  }
  void write(Hdf5Writer& file, const std::string& name) const {
    file.write(name, {values_.size() / columns_, columns_}, values_.data());
  }

 private:
  std::size_t columns_;
  std::vector<T> values_;
};

void write_parts(Hdf5Writer& file, const std::vector<MovingPart>& parts) {
  std::vector<std::int32_t> parent, coordinate;
  std::vector<std::uint8_t> slides;
  std::vector<double> multiplier, offset;
  Table<double> origin(12), axis(3);
  for (const MovingPart& part : parts) {
    parent.push_back(part.parent);
    coordinate.push_back(part.coordinate);
    slides.push_back(part.slides);
    multiplier.push_back(part.multiplier);
    offset.push_back(part.offset);
    const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> rows = part.origin.matrix().topRows<3>();
    origin.add(rows.reshaped<Eigen::RowMajor>());
    axis.add(part.axis);
  }
  file.write("part/parent", parent);
  file.write("part/coordinate", coordinate);
  file.write("part/slides", slides);
  file.write("part/multiplier", multiplier);
  file.write("part/offset", offset);
  origin.write(file, "part/origin");
  axis.write(file, "part/axis");
}

void write_pieces(Hdf5Writer& file, const std::vector<RobotShape::Piece>& pieces) {
  std::vector<std::int32_t> part, vertices, triangles;
  std::vector<float> opacity;
  Table<float> colour(3), position(3), normal(3);
  Table<std::int32_t> corner(3);
  for (const auto& [of, mesh] : pieces) {
    part.push_back(of);
    vertices.push_back(static_cast<std::int32_t>(mesh.vertices.size()));
    triangles.push_back(static_cast<std::int32_t>(mesh.triangles.size()));
    opacity.push_back(mesh.opacity);
    colour.add(mesh.colour);
    for (const Eigen::Vector3f& vertex : mesh.vertices) position.add(vertex);
    for (const Eigen::Vector3f& vector : mesh.normals) normal.add(vector);
    for (const Eigen::Vector3i& triangle : mesh.triangles) corner.add(triangle);
  }
  file.write("piece/part", part);
  file.write("piece/vertices", vertices);
  file.write("piece/triangles", triangles);
  file.write("piece/opacity", opacity);
  colour.write(file, "piece/colour");
  position.write(file, "vertex/position");
  normal.write(file, "vertex/normal");
  corner.write(file, "triangle/vertex");
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
  file.attribute("joints", fmt::format("{}", fmt::join(robot.body().moving(), " ")));
  write("joint/lower", robot.lower());
  write("joint/upper", robot.upper());
  file.attribute("pen_part", static_cast<std::int64_t>(pen.part));
  write("pen/place", Eigen::Vector3d(pen.pose.translation()));
  write("plane/origin", plane.origin);
  write("plane/u", plane.u);
  write("plane/v", plane.v);
  file.attribute("plane_scale", plane.scale);
  file.attribute("half_side", settings.half_side);
  file.attribute("deviation", shape.deviation);
  write_parts(file, shape.parts);
  write_pieces(file, shape.pieces);
  file.close();
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "A robot's parts, joints and surfaces for a viewer", hbr::run);
}
