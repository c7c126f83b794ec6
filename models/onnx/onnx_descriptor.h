// A network trained elsewhere as descriptor: an autoencoder 784 -> d -> 784, d up to 8, in an ONNX file, run
// by OpenCV. It takes one image at a time, in any shape of 784 numbers, and gives the reconstruction, 784
// numbers in any shape. Which tensors are position and reconstruction: tensors.h.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "models/descriptor/reconstructing_descriptor.h"
#include "models/onnx/onnx_settings.h"

namespace hbr::inline onnx {

class OnnxDescriptor final : public ReconstructingDescriptor {
 public:
  // model: the content of the ONNX file `where`, which leads the errors and beside which weights may be that
  // are not in it. Throws InputError where OpenCV can't run it, its input is no image, or position and
  // reconstruction are not clear.
  OnnxDescriptor(std::string_view model, const std::string& where, const OnnxSettings& settings = {});
  explicit OnnxDescriptor(const Hdf5Reader& file);
  ~OnnxDescriptor() override;

  // The settings with all that was read from the network: tensors' names and the input's shape.
  const OnnxSettings& settings() const;

  // Positions are as the network gives them where those of the images [n x 784] all lie in [-1, 1]^d;
  // otherwise they are scaled so that they do. `raw` [n x d] are these images' positions without scaling.
  // Throws InputError where a coordinate is the same for all images.
  void place(const Rows& raw);

  // One image at a time, in one thread: OpenCV promises the same bits for no other batch. Throws InputError
  // where a number that comes out is not finite.
  void reconstruct(Eigen::Index n, const float* images, float* position, float* decoded) const override;
  void write(Hdf5Writer& file) const override;

 private:
  struct Network;
  OnnxDescriptor(std::unique_ptr<Network> network);

  std::unique_ptr<Network> network_;
  Placement placement_;
};

}  // namespace hbr::inline onnx
