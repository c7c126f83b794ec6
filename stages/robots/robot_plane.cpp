// Where a robot draws: the plane of its space on which it reaches what the arm reached, as large as it can
// (method: transfer).
#include <fmt/core.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "models/robot/plane/find_plane.h"
#include "models/robot/plane/missing_part.h"
#include "models/robot/plane/plane_file.h"
#include "models/robot/plane/refine_plane.h"
#include "models/robot/plane/robot_on_plane.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/artifact/run_settings.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/hierarchy/drawing_settings.h"

namespace hbr::inline stages {
namespace {

struct PlaneStage {
  std::uint64_t seed = 0;
  double half_side = 0;
  RobotSettings robot;
  PlaneSearchSettings search;
};

template <class Fields>
void describe(Fields& f, PlaneStage& s) {
  describe_seed(f, s.seed);
  describe_half_side(f, s.half_side);
  f.table("robot", s.robot, "the robot");
  f.table("search", s.search, "the search for its plane");
}

// A tip that needs the last of a joint's range leaves the search of layer 1 few ways to get there.
constexpr double kMargin = 0.05;
constexpr int kSamples = 20000;  // starts for inverse kinematics
// While the plane is sought, a point counts as covered within this share of the tolerance: layer 1 needs the
// rest.
constexpr double kStrict = 0.1;
constexpr double kAtTheShoulder = 1e-6;  // m

// Half of them the outermost in each direction, where a plane fails first, half over all.
std::vector<Eigen::Vector2d> some_of(const std::vector<Eigen::Vector2d>& points, int count) {
  const auto half = static_cast<std::size_t>(count) / 2;
  std::vector<Eigen::Vector2d> some(half, Eigen::Vector2d::Zero());
  for (const Eigen::Vector2d& p : points) {
    const double turn = std::atan2(p[1], p[0]) / (2 * std::numbers::pi) + 0.5;  // in [0, 1]
    Eigen::Vector2d& outermost =
        some[std::min(static_cast<std::size_t>(turn * static_cast<double>(half)), half - 1)];
    if (p.squaredNorm() > outermost.squaredNorm()) outermost = p;
  }
  for (std::size_t i = 0; i < std::min(half, points.size()); ++i)
    some.push_back(points[i * points.size() / std::min(half, points.size())]);
  return some;
}

// Robots with many links take minutes: they say how far they are, at most every few seconds.
class Progress {
 public:
  explicit Progress(const std::string& robot) : robot_(robot), last_(Clock::now()) {}
  void tell(const std::string& what) {
    if (Clock::now() - last_ < std::chrono::seconds(10)) return;
    fmt::print(stderr, "{} {}\n", robot_, what);
    last_ = Clock::now();
  }

 private:
  using Clock = std::chrono::steady_clock;
  std::string robot_;
  Clock::time_point last_;
};

const char* described(BoardKind kind) {
  return kind == BoardKind::level ? "a level" : kind == BoardKind::upright ? "an upright" : "a leaning";
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

  if (std::ranges::all_of(points, [](const Eigen::Vector2d& p) { return p.norm() < kAtTheShoulder; }))
    throw InputError(
        "{}: all {} points of the arm are at its shoulder; expected some that it can draw between",
        stage.input("layer1").string(), points.size());

  // It stands nowhere yet.
  const RobotOnPlane robot = make_robot(settings.robot, DrawingPlane::facing({0, 0, 0}, 0, 0, 1));
  if (const std::string& why = robot.body().impossible_dynamics(); !why.empty())
    fmt::print(stderr, "{}: {}; `make all` ends at {}_dynamics\n", robot.name(), why, robot.name());
  const Clearance clearance(robot.body(), robot.tip());
  Progress progress(robot.name());
  const ReachMap map(robot.body(), robot.tip(), clearance, settings.search.samples, kMargin,
                     seed.child("map"), workers);
  progress.tell("knows where its pen can be");
  const Reach kept_off_limits(robot.body(), robot.tip(), clearance, kSamples, kMargin, seed.child("fit"));
  const double tolerance = settings.robot.off_plane_tolerance;
  const double floor =
      settings.search.below_floor ? -std::numeric_limits<double>::infinity() : floor_under(robot.body());
  const BoardRules rules(clearance, board_kind_named(settings.search.board), floor);
  progress.tell("looks for a board");
  const Board board =
      find_plane(robot.body(), rules, map, kept_off_limits, some_of(points, settings.search.points),
                 settings.half_side, kStrict * tolerance, settings.search, workers)
          .board;

  progress.tell("has a board; counts what it reaches there");
  const Reach whole(robot.body(), robot.tip(), clearance, kSamples, 0, seed.child("coverage"));
  const std::vector<double> distances = distances_to_reach(board, whole, points, workers);

  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  const double covered = write_plane(file, board.plane, points, distances, tolerance);
  file.close();
  fmt::print(stderr, "{} reaches {:.2f} % of the arm's {} points at {:.3g} times its size, on {} board\n",
             robot.name(), 100 * covered, points.size(), board.plane.scale,
             described(board_kind(board.plane)));
  if (const std::string missing = missing_part(points, distances, tolerance); !missing.empty())
    fmt::print(stderr, "{} misses {}\n", robot.name(), missing);
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "The drawing plane of a robot", hbr::run);
}
