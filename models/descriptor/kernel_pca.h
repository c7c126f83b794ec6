// Kernel principal components (Schölkopf, Smola and Müller 1998) of some training images, the landmarks, with
// a Gaussian kernel. The way back from a position to an image is a kernel ridge regression, learned from all
// training images (Bakır, Weston and Schölkopf 2004, "Learning to find pre-images"), as scikit-learn's
// KernelPCA has it, with the landmarks' positions as its centres.
#pragma once

#include <cstdint>
#include <span>

#include "models/descriptor/reconstructing_descriptor.h"
#include "pipeline/core/settings.h"

namespace hbr::inline descriptor {

struct KernelPcaSettings {
  int landmarks = 0;
  double gamma = 0;
  double preimage_gamma = 0;
  double ridge = 0;
};
template <class Fields>
void describe(Fields& f, KernelPcaSettings& s) {
  f.number("landmarks", s.landmarks, Range{1, 1e4},
           "training images, taken evenly, that span the components");
  f.number("gamma", s.gamma, Range{0, 1e3},
           "of the kernel exp(-gamma |x - y|^2) of two images; 0: its limit, the linear kernel");
  f.number("preimage_gamma", s.preimage_gamma, Range{1e-6, 1e6},
           "the same of two positions, for the way back");
  f.number("ridge", s.ridge, Range{1e-9, 1e9}, "penalty of the way back");
}

class KernelPca final : public ReconstructingDescriptor {
 public:
  // Fits to images of 784 bytes; their positions fill [-1, 1]^d. Throws InputError where there are fewer than
  // `landmarks` or these span too few components.
  KernelPca(const KernelPcaSettings& settings, std::span<const std::uint8_t> images, int dimension);
  explicit KernelPca(const Hdf5Reader& file);

  void reconstruct(Eigen::Index n, const float* images, float* position, float* decoded) const override;
  void write(Hdf5Writer& file) const override;

 private:
  void fit_components(int dimension);
  void fit_way_back(const Rows& images, const Rows& positions, double ridge);
  Rows positions_of(const Rows& images) const;

  float gamma_, preimage_gamma_;
  Rows landmarks_;   // [m x 784]
  Rows squares_;     // [1 x m] |landmark|^2
  Rows components_;  // [d x m]: position = components * kernel values + origin
  Rows origin_;      // [1 x d]
  Rows centres_;     // [m x d]
  Rows mean_;        // [1 x 784]
  Rows painter_;     // [784 x m]: image = mean + painter * kernel values of the position
};

}  // namespace hbr::inline descriptor
