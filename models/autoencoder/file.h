// Networks in files, see pipeline/artifact/FORMAT.md.
#pragma once

#include <filesystem>

#include "models/autoencoder/autoencoder.h"
#include "pipeline/artifact/hdf5_file.h"

namespace hbr::inline autoencoder {

// Writes weights/LAYER/kernel and weights/LAYER/bias, and the attributes `latent_size`, `leak`,
// `hidden` and `output`.
void write_autoencoder(Hdf5Writer& file, const Autoencoder& autoencoder);

// Throws InputError, naming file and array, where a shape is not the network's or a number is not finite.
Autoencoder load_autoencoder(const std::filesystem::path& path);

}  // namespace hbr::inline autoencoder
