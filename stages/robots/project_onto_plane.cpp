// Layer 1 of another robot, each elite moved exactly onto the drawing plane: to its own place there, within
// the joints' limits, with the joints as much alike as the place allows. Then the arm's points that have no
// elite near them get one, where the robot can come there: from the nearest elites, or by inverse kinematics.
#include "models/robot/plane/fill_gaps.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/parallel.h"
#include "pipeline/hierarchy/layers/points.h"
#include "pipeline/qd/places.h"
#include "stages/layers/body.h"
#include "stages/layers/description.h"

namespace {

// As of a layer of points, which it is for those that read it.
struct ProjectionSlice : hbr::RunTable {
  std::string kind;
  hbr::PointsSettings layer;
  nlohmann::json body;
  double spacing = 0;
};
template <class Fields>
void describe(Fields& f, ProjectionSlice& s) {
  describe_run(f, s);
  f.choice("kind", s.kind, {"points"}, "of layer");
  f.table("layer", s.layer, "its settings");
  f.raw_table("body", s.body, "the robot");
  f.number("spacing", s.spacing, hbr::Range{1e-4, 10}, "l: of layer 1, descriptor units");
}

// What is told of all elites.
struct Errors {
  std::vector<float> off_plane, distance, variance;
  explicit Errors(std::size_t n) : off_plane(n), distance(n), variance(n) {}
  void set(std::size_t i, const hbr::PointErrors& errors) {
    off_plane[i] = static_cast<float>(errors.off_plane);
    distance[i] = static_cast<float>(errors.distance);
    variance[i] = static_cast<float>(errors.variance);
  }
  void write(hbr::Hdf5Writer& file, const std::string& when) const {
    file.write(when + "/off_plane", off_plane);
    file.write(when + "/distance", distance);
    file.write(when + "/variance", variance);
  }
};

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<ProjectionSlice>();
  const hbr::Frame frame{s.layer.half_side, 0};
  const auto body = hbr::make_body(s.body, stage.name(), stage);
  const hbr::RobotOnPlane& robot = hbr::on_plane(*body);
  const hbr::Elites before = hbr::read_elites(stage.input("robot_layer1"));
  const hbr::Elites arm = hbr::read_elites(stage.input("layer1"));
  if (before.solution.cols() != robot.dof() || before.measures.cols() != 2 || arm.measures.cols() != 2)
    throw hbr::InputError("{}: elites of {} genes; expected the {} joints of robot '{}'",
                          stage.input("robot_layer1").string(), before.solution.cols(), robot.dof(),
                          robot.name());

  hbr::Elites after = before;
  const auto n = static_cast<std::size_t>(before.size());
  Errors old_errors(n), new_errors(n);
  hbr::Workers workers(stage.threads());
  workers.for_each(n, [&](std::size_t i) {
    const auto row = static_cast<Eigen::Index>(i);
    Eigen::VectorXd joints(robot.dof());
    hbr::decode_joints(robot, before.solution.row(row).data(), joints.data());
    const Eigen::Vector3d place = hbr::place_of(robot, frame, before, row);
    old_errors.set(i, hbr::point_errors(robot, place, joints));
    new_errors.set(i, hbr::point_errors(robot, place, hbr::project_point(robot, frame, after, row)));
  });
  // The seed is that of the stage's former name, so that robots keep their points.
  const hbr::Seed seed = hbr::Seed(s.seed).child(robot.name() + "_polish").child(s.replication);
  hbr::fill_gaps(robot, frame, arm.measures, static_cast<float>(s.spacing), after, seed);

  hbr::Hdf5Writer file(stage.output());
  hbr::write_elites(file, after, {});
  hbr::write_description(file, *hbr::make_points(s.layer, {robot}));
  stage.write_settings(file);
  file.write("before/id", before.id);
  old_errors.write(file, "before");
  new_errors.write(file, "after");
  file.write("arm_points", {static_cast<std::size_t>(arm.size()), 2}, arm.measures.data());
  file.write("before/nearest", hbr::nearest_elites(arm.measures, before).distance);
  file.write("after/nearest", hbr::nearest_elites(arm.measures, after).distance);
  file.close();
}

}  // namespace

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "Layer 1 of another robot, exactly on its plane", run);
}
