// The largest square boards that a robot can draw on all over, one of each kind: a first look, by its coarse
// reach alone.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "models/robot/plane/board_rules.h"
#include "pipeline/core/parallel.h"

namespace hbr::inline robots {

struct KindOfBoard {
  BoardKind kind;
  std::optional<Board> board;  // half_side is 1: its scale is half its side, m; none where there is none
};

// Level, upright and leaning, for the link `tip` and those of these joints that move it, the others as `rest`
// has them (Body); from `samples` configurations. Nothing of a board is below what the robot stands on.
// Deterministic. InputError as for ReachMap, and where no joint moves the tip.
std::vector<KindOfBoard> best_boards(const RobotModel& model, const std::vector<std::string>& joints,
                                     const std::map<std::string, double>& rest, int tip, int samples,
                                     Workers& workers);

const char* board_kind_name(BoardKind kind);

}  // namespace hbr::inline robots
