// The images of a repertoire that draws, kept beside its elites.
#pragma once

#include <cstdint>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/parallel.h"
#include "pipeline/hierarchy/layer_model.h"

namespace hbr::inline stages {

// All images of all elites, in steps of 1/255: [elites x images x 28 x 28].
std::vector<std::uint8_t> draw_all(const LayerModel& model, const Elites& elites, Workers& workers);

// Writes `image` [n x 28 x 28], or [n x images x 28 x 28] where a genome draws more than one.
void write_images(Hdf5Writer& file, const LayerModel& model, const Elites& elites, Workers& workers);

}  // namespace hbr::inline stages
