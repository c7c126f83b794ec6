// A search as a stage: built from its table, run with progress and checkpoints, written as a repertoire file.
#pragma once

#include <functional>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/hierarchy/layer_model.h"
#include "pipeline/qd/variation.h"
#include "stages/layers/search_settings.h"

namespace hbr::inline stages {

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
std::unique_ptr<Variation> make_variation(const GenomeShape& genome, const SearchTable& table);

}  // namespace hbr::inline stages
