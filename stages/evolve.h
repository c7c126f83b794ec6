// A search as a stage: built from its table, run with progress and checkpoints, written as a repertoire file.
#pragma once

#include <functional>

#include "models/arm/planar_arm.h"
#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/hierarchy/digit_layer.h"
#include "pipeline/qd/evaluator.h"
#include "pipeline/qd/variation.h"
#include "stages/settings.h"

namespace hbr {

// Range of the descriptor, the same in every dimension.
struct DescriptorRange {
  float low = 0, high = 1;
};

// Evolves, or goes on from the stage's checkpoint, and writes the stage's output. `more`, where given, adds
// arrays made from the finished elites.
void evolve(StageRun& stage, const SearchTable& table, const Variation& variation, const Evaluator& evaluator,
            Seed seed, DescriptorRange range = {},
            const std::function<void(Hdf5Writer&, const Elites&)>& more = nullptr);

ContainerSettings container_settings(const SearchTable& table, DescriptorRange range);
PolynomialMutation fixed_length(int genes, const SearchTable& table);

// The bodies and layers that slices name.
PlanarArm make_arm(const ArmTable& table);
Frame make_frame(const LinesSlice& slice);
ArcReading make_reading(const ArcReadingTable& table);
Pencil make_pencil(const PencilTable& table);
// Layer 1 as in the stage's input `name`, on the planar arm.
PointLayer read_points(const StageRun& stage, const std::string& name, const Robot& robot,
                       const Frame& frame);
LineLayer read_lines(const StageRun& stage, const std::string& name, const Frame& frame);
ArcLayer read_arcs(const StageRun& stage, const std::string& name, const Frame& frame,
                   const std::string& controller);

}  // namespace hbr
