// Layer 1 of another robot, each elite moved exactly onto the drawing plane: to its own place there, within
// the joints' limits, with the joints as much alike as the place allows. Then the arm's points that have no
// elite near them get one, where the robot can come there.
#include <algorithm>
#include <cmath>

#include "models/simbody/clearance.h"
#include "models/simbody/plane_file.h"
#include "models/simbody/polish.h"
#include "models/simbody/robot_on_plane.h"
#include "pipeline/core/parallel.h"
#include "stages/evolve.h"

namespace {

struct PolishSlice {
  double half_side = 0;
  double spacing = 0;
  hbr::RobotSettings robot;
};
template <class Fields>
void describe(Fields& f, PolishSlice& s) {
  f.number("half_side", s.half_side, hbr::Range{1e-3, 100}, "L: half the side of the drawing area, m");
  f.number("spacing", s.spacing, hbr::Range{1e-4, 10}, "l: of layer 1, descriptor units");
  f.table("robot", s.robot, "the robot");
}

// What is told of an elite: how far it is off the plane and from its place on it (m of the robot), and the
// variance of its joints (rad^2).
struct Errors {
  std::vector<float> off_plane, distance, variance;
  explicit Errors(std::size_t n) : off_plane(n), distance(n), variance(n) {}
  void set(std::size_t i, const hbr::RobotOnPlane& robot, const Eigen::Vector3d& target,
           const Eigen::VectorXd& joints) {
    const Eigen::Vector3d tip = robot.body().position(robot.tip(), joints.data());
    off_plane[i] = static_cast<float>(std::abs(robot.plane().to_pen(tip).off_plane));
    distance[i] = static_cast<float>((tip - target).norm());
    variance[i] = static_cast<float>(hbr::joint_variance(joints.data(), robot.dof()));
  }
  void write(hbr::Hdf5Writer& file, const std::string& when) const {
    file.write(when + "/off_plane", off_plane);
    file.write(when + "/distance", distance);
    file.write(when + "/variance", variance);
  }
};

// Of each of the arm's points the distance to the nearest elite, both in units of the descriptor.
std::vector<float> nearest(const hbr::Rows& points, const hbr::Elites& elites) {
  std::vector<float> distances;
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    distances.push_back(
        std::sqrt((elites.measures.rowwise() - points.row(i)).rowwise().squaredNorm().minCoeff()));
  return distances;
}

Eigen::VectorXf genes_of(const hbr::RobotOnPlane& robot, const Eigen::VectorXd& joints) {
  const Eigen::ArrayXd range = (robot.upper() - robot.lower()).array().max(1e-12);
  return ((joints - robot.lower()).array() / range).max(0).min(1).cast<float>();
}

// What a genome does: its joints, its place and its fitness.
void perform(const hbr::RobotOnPlane& robot, const hbr::Frame& frame, hbr::Elites& elites, Eigen::Index row,
             Eigen::VectorXd& joints) {
  hbr::decode_joints(robot, elites.solution.row(row).data(), joints.data());
  hbr::Pen pen;
  robot.pens(1, joints.data(), &pen);
  elites.measures.row(row) =
      frame.point_descriptor(pen.position).array().max(0).min(1).cast<float>().transpose();
  elites.objective[row] = static_cast<float>(-hbr::joint_variance(joints.data(), robot.dof()));
}

// Moves a copy of one of the nearest elites to each of the arm's points that has none within l, again and
// again while that succeeds: the edge of a gap is where the next start stands. Ids go on after the last.
void fill_gaps(const hbr::RobotOnPlane& robot, const hbr::Frame& frame, const hbr::Clearance& clearance,
               const hbr::Board& board, const hbr::Rows& points, float spacing, double tolerance,
               hbr::Elites& elites) {
  constexpr int kStarts = 4;
  Eigen::VectorXd joints(robot.dof());
  for (bool more = true; more;) {
    more = false;
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
      Eigen::VectorXf away = (elites.measures.rowwise() - points.row(i)).rowwise().squaredNorm().cwiseSqrt();
      if (away.minCoeff() <= spacing) continue;
      const Eigen::Vector3d target =
          robot.plane().to_robot(frame.point(points.row(i).transpose().cast<double>()));
      for (int k = 0; k < kStarts; ++k) {
        Eigen::Index start = 0;
        away.minCoeff(&start);
        away[start] = 1e9f;
        hbr::decode_joints(robot, elites.solution.row(start).data(), joints.data());
        const Eigen::VectorXf genes = genes_of(robot, hbr::polish(robot, target, joints));
        hbr::decode_joints(robot, genes.data(), joints.data());
        const Eigen::Vector3d tip = robot.body().position(robot.tip(), joints.data());
        if ((tip - target).norm() > tolerance || !clearance.clear(joints.data(), board)) continue;
        const Eigen::Index row = elites.size();
        elites.solution.conservativeResize(row + 1, Eigen::NoChange);
        elites.measures.conservativeResize(row + 1, Eigen::NoChange);
        elites.objective.conservativeResize(row + 1);
        elites.solution.row(row) = genes.transpose();
        elites.parent.push_back(elites.id[start]);
        elites.id.push_back(elites.id.back() + 1);
        perform(robot, frame, elites, row, joints);
        more = true;
        break;
      }
    }
  }
}

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<PolishSlice>();
  const hbr::Frame frame{s.half_side, 0};
  const hbr::RobotOnPlane robot = hbr::make_robot(s.robot, hbr::load_plane(stage.input("plane")));
  const hbr::Clearance clearance(robot.body(), robot.tip());
  const hbr::Board board{robot.plane(), s.half_side};
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
    const Eigen::Vector3d target =
        robot.plane().to_robot(frame.point(before.measures.row(row).transpose().cast<double>()));
    old_errors.set(i, robot, target, joints);

    const Eigen::VectorXf polished = genes_of(robot, hbr::polish(robot, target, joints));
    hbr::decode_joints(robot, polished.data(), joints.data());
    if (clearance.clear(joints.data(), board)) after.solution.row(row) = polished.transpose();
    perform(robot, frame, after, row, joints);
    new_errors.set(i, robot, target, joints);
  });
  fill_gaps(robot, frame, clearance, board, arm.measures, static_cast<float>(s.spacing),
            s.robot.off_plane_tolerance, after);

  hbr::Hdf5Writer file(stage.output());
  hbr::write_elites(file, after, {});
  stage.write_settings(file);
  old_errors.write(file, "before");
  new_errors.write(file, "after");
  file.write("arm_points", {static_cast<std::size_t>(arm.size()), 2}, arm.measures.data());
  file.write("before/nearest", nearest(arm.measures, before));
  file.write("after/nearest", nearest(arm.measures, after));
  file.close();
}

}  // namespace

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "Layer 1 of another robot, exactly on its plane", run);
}
