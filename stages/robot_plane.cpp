// Where a robot draws: a plane of its space on which it reaches what the arm reached (method: transfer).
#include <fmt/core.h>

#include "models/simbody/plane_file.h"
#include "models/simbody/refine_plane.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/artifact/stage.h"

namespace hbr {
namespace {

struct PlaneStage {
  std::uint64_t seed = 0;
  double half_side = 0;
  RobotSettings robot;
};

template <class Fields>
void describe(Fields& f, PlaneStage& s) {
  f.number("seed", s.seed, Range{0, 9e15}, "master seed");
  f.number("half_side", s.half_side, Range{1e-3, 1e3}, "L, m: the arm's drawing area is [-L, L]^2");
  f.table("robot", s.robot, "the robot");
}

// A tip that needs the last of a joint's range leaves the search of layer 1 few ways to get there.
constexpr double kMargin = 0.05;
constexpr int kSamples = 20000;       // starts for inverse kinematics
constexpr std::size_t kPoints = 400;  // that the plane is fitted to; coverage counts all

std::vector<Eigen::Vector2d> spread(const std::vector<Eigen::Vector2d>& points) {
  std::vector<Eigen::Vector2d> some;
  const std::size_t n = std::min(kPoints, points.size());
  for (std::size_t i = 0; i < n; ++i) some.push_back(points[i * points.size() / n]);
  return some;
}

void run(StageRun& stage) {
  const auto settings = settings_from_json<PlaneStage>(stage.settings(), stage.name());
  const Seed seed = Seed(settings.seed).child("robot_plane").child(settings.robot.name);
  Workers workers(stage.threads());

  const Elites arm = read_elites(stage.input("layer1"));
  if (arm.measures.cols() != 2)
    throw InputError("{}: measures of {} columns; expected the 2 of layer 1", stage.input("layer1").string(),
                     arm.measures.cols());
  std::vector<Eigen::Vector2d> points;
  for (Eigen::Index i = 0; i < arm.size(); ++i)
    points.push_back((2 * arm.measures.row(i).transpose().cast<double>().array() - 1) * settings.half_side);

  const RobotOnPlane start = make_robot(settings.robot, settings.robot.plane.plane());
  const Reach kept_off_limits(start.body(), start.tip(), kSamples, kMargin, seed.child("fit"));
  const DrawingPlane plane = refine_plane(start, kept_off_limits, spread(points), workers);

  const RobotOnPlane robot = make_robot(settings.robot, plane);
  const Reach whole(robot.body(), robot.tip(), kSamples, 0, seed.child("coverage"));
  const std::vector<double> distances = distances_to_reach(robot, whole, points, workers);

  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  const double covered = write_plane(file, plane, points, distances, settings.robot.off_plane_tolerance);
  file.close();
  fmt::print(stderr, "{} reaches {:.2f} % of the arm's {} points\n", robot.name(), 100 * covered,
             points.size());
}

}  // namespace
}  // namespace hbr

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "The drawing plane of a robot", hbr::run);
}
