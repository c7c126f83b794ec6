// The learned descriptors that a profile can name.
#pragma once

#include <filesystem>
#include <memory>

#include "pipeline/hierarchy/descriptor.h"

namespace hbr::inline stages {

// From autoencoder/RR.h5 or descriptor.h5, see pipeline/artifact/FORMAT.md.
std::unique_ptr<Descriptor> load_descriptor(const std::filesystem::path& path);

// How a descriptor made by load_descriptor paints images again: both [n x 784], in [0, 1]. Thread-safe.
void decode_images(const Descriptor& descriptor, Eigen::Index n, const float* images, float* decoded);

}  // namespace hbr::inline stages
