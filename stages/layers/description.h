// What the numbers of a repertoire are, as its layer tells it, kept in its file for whoever reads it.
#pragma once

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/hierarchy/layer_model.h"

namespace hbr::inline stages {

// Attributes of the arrays `solution`, `measures` and `objective`, which are written before; FORMAT.md has
// them.
void write_description(Hdf5Writer& file, const LayerModel& model);

}  // namespace hbr::inline stages
