// Layer 1 of another robot (paper, section 5.2): points on a plane of its space, scaled to the arm's drawing
// area.
#include "models/simbody/clearance.h"
#include "models/simbody/plane_file.h"
#include "models/simbody/robot_on_plane.h"
#include "stages/evolve.h"

namespace {

struct RobotPointsEvolution : hbr::RunTable {
  double half_side = 0;
  std::string cost;
  hbr::RobotSettings robot;
  hbr::SearchTable search;
};
template <class Fields>
void describe(Fields& f, RobotPointsEvolution& s) {
  describe_run(f, s);
  f.number("half_side", s.half_side, hbr::Range{1e-3, 100}, "L: half the side of the drawing area, m");
  f.choice("cost", s.cost, {"joint_variance", "few_joints"}, "what layer 1 minimises");
  f.table("robot", s.robot, "the robot");
  f.table("search", s.search, "the search");
}

// Points without the configurations that run the robot into itself or its board.
class FreePoints final : public hbr::Evaluator {
 public:
  FreePoints(const hbr::PointEvaluator& points, const hbr::RobotOnPlane& robot, double half_side)
      : points_(points),
        robot_(robot),
        clearance_(robot.body(), robot.tip()),
        board_{robot.plane(), half_side} {}
  int descriptor_size() const override { return points_.descriptor_size(); }
  bool deterministic() const override { return true; }
  void evaluate(hbr::Batch& batch, Eigen::Index begin, Eigen::Index end, hbr::Seed seed) const override {
    points_.evaluate(batch, begin, end, seed);
    Eigen::VectorXd joints(robot_.dof());
    for (Eigen::Index i = begin; i < end; ++i) {
      if (!batch.valid[i]) continue;
      hbr::decode_joints(robot_, batch.genome.row(i).data(), joints.data());
      batch.valid[i] = clearance_.clear(joints.data(), board_);
    }
  }

 private:
  const hbr::PointEvaluator& points_;
  const hbr::RobotOnPlane& robot_;
  hbr::Clearance clearance_;
  hbr::Board board_;
};

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<RobotPointsEvolution>();
  const hbr::RobotOnPlane robot = hbr::make_robot(s.robot, hbr::load_plane(stage.input("plane")));
  const hbr::PointEvaluator points(robot, hbr::Frame{s.half_side, 0}, hbr::joint_cost(s.cost),
                                   s.robot.off_plane_tolerance);

  evolve(stage, s.search, hbr::fixed_length(static_cast<int>(robot.dof()), s.search),
         FreePoints(points, robot, s.half_side), hbr::Seed(s.seed).child(stage.stage()).child(s.replication));
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Layer 1 of another robot", run); }
