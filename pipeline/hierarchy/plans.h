// Genomes of a layer, decoded, and what they ask of the layer below: what is executed, whether it is stored
// in a repertoire or being evolved.
#pragma once

#include <vector>

#include "pipeline/hierarchy/decoder.h"
#include "pipeline/hierarchy/layer.h"
#include "pipeline/hierarchy/point_layer.h"
#include "pipeline/qd/elites.h"

namespace hbr::inline hierarchy {

class Plans {
 public:
  // Plan i is that of row first + i, lengths[first + i] genes (nullptr: all). The layer below has to outlive
  // the plans. Which of its elites answers to a command does not depend on where the command is given, so it
  // is asked once, here.
  void make(const Decoder& decoder, const PointLayer& points, const Layer& below, const Rows& genomes,
            const std::int32_t* lengths, Eigen::Index first, int n);

  // Whether the genome asks for something that can be.
  bool possible(int plan) const { return count_[plan] > 0; }
  // Execution group[i] carries out plan which[i / repeat].
  void perform(Executions& executions, Group group, const std::int32_t* which, int repeat) const;

 private:
  void ask_below(const Frame& frame, int command_size);
  void command(Executions& executions, Group group, const std::int32_t* which, int repeat, int k) const;

  const Layer* below_ = nullptr;
  bool relative_ = false, displaces_ = false;
  bool even_ = true;                        // all plans have as many commands
  int most_ = 0;                            // commands of the longest plan
  std::vector<std::int32_t> count_;         // commands of each plan
  std::vector<std::int32_t> elite_;         // [plan x command] of the layer below
  std::vector<Eigen::Vector2d> move_;       // [plan x command] of relative plans, m
  std::vector<float> step_[2];              // the same in layer 1's descriptor units
  std::vector<PenPlacement> placement_;     // [plan], or none
  std::vector<Eigen::Vector2d> displaced_;  // [plan x command], or none
  std::vector<double> commands_;            // [plan x command x size], kept for their memory alone
  std::vector<float> coordinates_;          // the same, a coordinate after the other
};

}  // namespace hbr::inline hierarchy
