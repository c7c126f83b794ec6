// Which learned descriptor the digits have.
#pragma once

#include <string>

#include "models/autoencoder/network.h"
#include "models/descriptor/kernel_pca.h"
#include "models/onnx/onnx_settings.h"

namespace hbr::inline stages {

struct DescriptorTable {
  std::string kind;
  std::string file;
  OnnxSettings onnx;
  KernelPcaSettings kernel_pca;
};
template <class Fields>
void describe(Fields& f, DescriptorTable& s) {
  f.choice("kind", s.kind, {"autoencoder", "onnx", "pca", "kernel_pca"},
           "autoencoder: trained here, one for each replication; onnx: a network trained elsewhere; pca, "
           "kernel_pca: components of the training images, autoencoder.latent_size of them");
  f.text("file", s.file, "of kind onnx: an autoencoder 784 -> d -> 784, see models/onnx/onnx_descriptor.h");
  f.table("onnx", s.onnx, "of that kind: how the file is read");
  f.table("kernel_pca", s.kernel_pca, "of that kind");
}

// What a descriptor depends on that is not an autoencoder trained here.
struct DescriptorSlice : DescriptorTable {
  int latent_size = 0;
};
template <class Fields>
void describe(Fields& f, DescriptorSlice& s) {
  f.choice("kind", s.kind, {"onnx", "pca", "kernel_pca"}, "which one");
  if (s.kind == "onnx") {
    f.text("file", s.file, "the network");
    f.table("onnx", s.onnx, "how it is read");
  } else {
    f.number("latent_size", s.latent_size, Range{1, net::kMaxLatent}, "components");
  }
  if (s.kind == "kernel_pca") f.table("kernel_pca", s.kernel_pca, "its numbers");
}

}  // namespace hbr::inline stages
