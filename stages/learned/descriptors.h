// The learned descriptors that a profile can name.
#pragma once

#include <filesystem>
#include <memory>

#include "pipeline/hierarchy/descriptor.h"

namespace hbr {

// From autoencoder/RR.h5 or descriptor.h5, see pipeline/artifact/FORMAT.md.
std::unique_ptr<Descriptor> load_descriptor(const std::filesystem::path& path);

}  // namespace hbr
