#include "stages/learned/descriptors.h"

#include "models/autoencoder/file.h"
#include "models/descriptor/kernel_pca.h"
#include "models/descriptor/pca.h"
#include "models/onnx/onnx_descriptor.h"
#include "pipeline/core/check.h"

namespace hbr {

std::unique_ptr<Descriptor> load_descriptor(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  if (!file.has_attribute("kind")) return std::make_unique<Autoencoder>(load_autoencoder(path));
  const std::string kind = file.text_attribute("kind");
  if (kind == "onnx") return std::make_unique<OnnxDescriptor>(file);
  if (kind == "pca") return std::make_unique<PrincipalComponents>(file);
  if (kind == "kernel_pca") return std::make_unique<KernelPca>(file);
  throw InputError("{}: attribute kind is '{}', expected onnx, pca or kernel_pca", path.string(), kind);
}

}  // namespace hbr
