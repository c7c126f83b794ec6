// By how much a drawing's stroke turns from one of its segments to the next.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "pipeline/hierarchy/executor.h"

namespace hbr::inline stages {

struct StrokeTurns {
  std::vector<float> turn;          // rad, in (-pi, pi]; to the left is positive
  std::vector<std::uint8_t> joint;  // [turn] 1 where one arc ends and the next begins
  float length = 0;                 // m
  float side = 0;                   // m, the greater one of the box around it
};

// Of the polygon through `points`, m. Segments of no length are passed over: the turn is that between the
// segments that move. `arc` segments in a row are an arc; 0: there are none.
StrokeTurns stroke_turns(std::span<const Eigen::Vector2d> points, int arc);

// Where the pen is put down by a genome and where each of its lines stops, m; empty where it asks for what
// can't be.
std::vector<Eigen::Vector2d> stops_of(const Executor& executor, const float* genome, int length);

}  // namespace hbr::inline stages
