#include "models/robot/plane/best_boards.h"

#include "models/robot/plane/search_plane.h"
#include "pipeline/core/check.h"

namespace hbr::inline robots {
namespace {

constexpr int kAcross = 11;  // points of a board in a row

// All over a square of 2 m.
std::vector<Eigen::Vector2d> square() {
  std::vector<Eigen::Vector2d> points;
  for (int row = 0; row < kAcross; ++row)
    for (int column = 0; column < kAcross; ++column)
      points.emplace_back(2. * column / (kAcross - 1) - 1, 2. * row / (kAcross - 1) - 1);
  return points;
}

// A gripper that opens and a flange that turns about the tip leave it where it is.
std::vector<std::string> joints_that_move(const Body& body, int tip) {
  Rng rng(Seed(0).child("joints that move"));
  Eigen::VectorXd moved = Eigen::VectorXd::Zero(body.dof());
  for (int i = 0; i < 10; ++i) {
    Eigen::VectorXd joints = body.lower();
    for (Eigen::Index k = 0; k < joints.size(); ++k)
      joints[k] += (body.upper()[k] - body.lower()[k]) * rng.uniform_double();
    Eigen::Matrix3Xd slopes;
    body.position(tip, joints.data(), &slopes);
    moved += slopes.colwise().norm().transpose();
  }
  std::vector<std::string> names;
  for (Eigen::Index k = 0; k < moved.size(); ++k)
    if (moved[k] > 1e-9) names.push_back(body.moving()[static_cast<std::size_t>(k)]);
  return names;
}

}  // namespace

std::vector<KindOfBoard> best_boards(const RobotModel& model, const std::vector<std::string>& joints,
                                     const std::map<std::string, double>& rest, int tip, int samples,
                                     Workers& workers) {
  const Body body(model, joints_that_move(Body(model, joints, rest), tip), rest);
  if (body.dof() == 0)
    throw InputError("{}: no joint moves '{}'; expected two or more", model.path.string(),
                     model.links[static_cast<std::size_t>(tip)].name);
  const Clearance clearance(body, tip);
  const ReachMap map(body, tip, clearance, samples, 0, Seed(0).child("best boards"), workers);
  std::vector<KindOfBoard> best;
  for (const BoardKind kind : {BoardKind::level, BoardKind::upright, BoardKind::leaning}) {
    const BoardRules rules(clearance, kind, floor_under(body));
    const std::vector<Board> found = search_planes(map, rules, square(), 1, shoulder(body), 1, workers);
    best.push_back({kind, found.empty() ? std::nullopt : std::optional(found.front())});
  }
  return best;
}

const char* board_kind_name(BoardKind kind) {
  return kind == BoardKind::level ? "level" : kind == BoardKind::upright ? "upright" : "leaning";
}

}  // namespace hbr::inline robots
