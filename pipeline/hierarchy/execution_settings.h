// How genomes are executed, as profiles say it: what the paper leaves open.
#pragma once

#include <string>

#include "pipeline/core/settings.h"
#include "pipeline/hierarchy/executor.h"
#include "pipeline/hierarchy/layer_evaluator.h"

namespace hbr::inline hierarchy {

struct StartSettings {
  std::string starts = {}, start_draws = {};
  // The robot is moved by drawn joint angles.
  Starts of(const Robot& robot) const {
    return {starts == "joints" ? &robot : nullptr, start_draws == "common"};
  }
};
template <class Fields>
void describe_starts(Fields& f, StartSettings& s) {
  f.choice("starts", s.starts, {"elites", "joints"},
           "what executions begin at is drawn from: elites of layer 1, or joint angles (and then the elite "
           "nearest to where they bring the pen)");
  f.choice("start_draws", s.start_draws, {"fresh", "common"},
           "starts are drawn for each evaluation anew, or once and for all");
}

template <class Fields>
void describe_way_points(Fields& f, std::string& way_points) {
  f.choice("way_points", way_points, {"reached", "commanded"},
           "a line begins at the elite that the one before reached, or where that one was to end");
}
inline WayPoints way_points_of(const std::string& name) {
  return name == "commanded" ? WayPoints::kCommanded : WayPoints::kReached;
}

template <class Fields>
void describe_sample_fitness(Fields& f, std::string& sample_fitness) {
  f.choice("sample_fitness", sample_fitness, {"nearest", "median"},
           "fitness of the sample whose descriptor is nearest to the median, or the median of the samples' "
           "fitness");
}
inline SampleFitness sample_fitness_of(const std::string& name) {
  return name == "median" ? SampleFitness::kMedian : SampleFitness::kNearest;
}

}  // namespace hbr::inline hierarchy
