#include "stages/learned/descriptors.h"

#include <vector>

#include "models/autoencoder/file.h"
#include "models/descriptor/kernel_pca.h"
#include "models/descriptor/pca.h"
#include "models/onnx/onnx_descriptor.h"
#include "pipeline/core/check.h"

namespace hbr::inline stages {

std::unique_ptr<Descriptor> load_descriptor(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  if (!file.has_attribute("kind")) return std::make_unique<Autoencoder>(load_autoencoder(path));
  const std::string kind = file.text_attribute("kind");
  if (kind == "onnx") return std::make_unique<OnnxDescriptor>(file);
  if (kind == "pca") return std::make_unique<PrincipalComponents>(file);
  if (kind == "kernel_pca") return std::make_unique<KernelPca>(file);
  throw InputError("{}: attribute kind is '{}', expected onnx, pca or kernel_pca", path.string(), kind);
}

void decode_images(const Descriptor& descriptor, Eigen::Index n, const float* images, float* decoded) {
  std::vector<float> position(static_cast<std::size_t>(n * descriptor.dimension()));
  if (const auto* network = dynamic_cast<const Autoencoder*>(&descriptor)) {
    network->encode(n, images, position.data());
    network->decode(n, position.data(), decoded);
  } else {
    dynamic_cast<const ReconstructingDescriptor&>(descriptor)
        .reconstruct(n, images, position.data(), decoded);
  }
}

}  // namespace hbr::inline stages
