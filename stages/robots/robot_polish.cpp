// Layer 1 of another robot, each elite moved exactly onto the drawing plane: to its own place there, within
// the joints' limits, with the joints as much alike as the place allows. Then the arm's points that have no
// elite near them get one, where the robot can come there: from the nearest elites, or by inverse kinematics.
#include <algorithm>
#include <cmath>
#include <optional>

#include "models/robot/plane/polish.h"
#include "models/robot/plane/reach.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/parallel.h"
#include "pipeline/hierarchy/layers/points.h"
#include "stages/layers/body.h"

namespace {

// As of a layer of points, which it is for those that read it.
struct PolishSlice : hbr::RunTable {
  std::string kind;
  hbr::PointsSettings layer;
  nlohmann::json body;
  double spacing = 0;
};
template <class Fields>
void describe(Fields& f, PolishSlice& s) {
  describe_run(f, s);
  f.choice("kind", s.kind, {"points"}, "of layer");
  f.table("layer", s.layer, "its settings");
  f.raw_table("body", s.body, "the robot");
  f.number("spacing", s.spacing, hbr::Range{1e-4, 10}, "l: of layer 1, descriptor units");
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

// Gives the arm's points that have no elite within l one of their own.
class Gaps {
 public:
  Gaps(const hbr::RobotOnPlane& robot, const hbr::Frame& frame, const hbr::Clearance& clearance,
       const hbr::Rows& points, float spacing, double tolerance)
      : robot_(robot),
        frame_(frame),
        clearance_(clearance),
        board_{robot.plane(), frame.half_side},
        points_(points),
        spacing_(spacing),
        tolerance_(tolerance) {}

  // From the nearest elites, again and again while that succeeds: the edge of a gap is where the next start
  // stands. What is left then, by inverse kinematics from anywhere. Ids go on after the last.
  void fill(hbr::Elites& elites, hbr::Seed seed) const {
    while (pass(elites, [&](const auto& target, const auto& away) { return near(elites, target, away); })) {
    }
    std::optional<hbr::Reach> reach;
    pass(elites, [&](const auto& target, const auto&) {
      if (!reach) reach.emplace(robot_.body(), robot_.tip(), clearance_, kSamples, 0, seed);
      return Found{-1, arrive(reach->nearest(target, board_, kAnywhere, tolerance_ / 10).joints, target)};
    });
  }

 private:
  static constexpr int kNear = 4, kAnywhere = 8;  // starts
  static constexpr int kSamples = 20000;          // where inverse kinematics may start

  struct Found {
    Eigen::Index parent = -1;
    Eigen::VectorXf genes;  // empty: there is no way
  };

  Found near(const hbr::Elites& elites, const Eigen::Vector3d& target, Eigen::VectorXf away) const {
    Eigen::VectorXd joints(robot_.dof());
    for (int k = 0; k < kNear; ++k) {
      Eigen::Index start = 0;
      away.minCoeff(&start);
      away[start] = 1e9f;
      hbr::decode_joints(robot_, elites.solution.row(start).data(), joints.data());
      if (Eigen::VectorXf genes = arrive(joints, target); genes.size() > 0) return {start, std::move(genes)};
    }
    return {};
  }

  Eigen::VectorXf arrive(const Eigen::VectorXd& start, const Eigen::Vector3d& target) const {
    Eigen::VectorXf genes = genes_of(robot_, hbr::polish(robot_, target, start));
    Eigen::VectorXd joints(robot_.dof());
    hbr::decode_joints(robot_, genes.data(), joints.data());
    const double distance = (robot_.body().position(robot_.tip(), joints.data()) - target).norm();
    if (distance > tolerance_ || !clearance_.clear(joints.data(), board_)) genes.resize(0);
    return genes;
  }

  // Calls find(target, distances of all elites from there) for each gap; whether any was filled.
  template <class Find>
  bool pass(hbr::Elites& elites, const Find& find) const {
    bool any = false;
    Eigen::VectorXd joints(robot_.dof());
    for (Eigen::Index i = 0; i < points_.rows(); ++i) {
      const Eigen::VectorXf away =
          (elites.measures.rowwise() - points_.row(i)).rowwise().squaredNorm().cwiseSqrt();
      if (away.minCoeff() <= spacing_) continue;
      const Eigen::Vector3d target =
          robot_.plane().to_robot(frame_.point(points_.row(i).transpose().cast<double>()));
      const Found found = find(target, away);
      if (found.genes.size() == 0) continue;
      const Eigen::Index row = elites.size();
      elites.solution.conservativeResize(row + 1, Eigen::NoChange);
      elites.measures.conservativeResize(row + 1, Eigen::NoChange);
      elites.objective.conservativeResize(row + 1);
      elites.solution.row(row) = found.genes.transpose();
      elites.parent.push_back(found.parent < 0 ? -1 : elites.id[static_cast<std::size_t>(found.parent)]);
      elites.id.push_back(elites.id.back() + 1);
      perform(robot_, frame_, elites, row, joints);
      any = true;
    }
    return any;
  }

  const hbr::RobotOnPlane& robot_;
  const hbr::Frame& frame_;
  const hbr::Clearance& clearance_;
  hbr::Board board_;
  const hbr::Rows& points_;
  float spacing_;
  double tolerance_;
};

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<PolishSlice>();
  const hbr::Frame frame{s.layer.half_side, 0};
  const auto body = hbr::make_body(s.body, stage.name(), stage);
  const hbr::RobotOnPlane& robot = hbr::on_plane(*body);
  const hbr::Clearance& clearance = robot.clearance();
  const hbr::Board board{robot.plane(), frame.half_side};
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
  const hbr::Seed seed = seed_of(stage, s);
  Gaps(robot, frame, clearance, arm.measures, static_cast<float>(s.spacing), robot.off_plane_tolerance())
      .fill(after, seed);

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
