// A network trained elsewhere as descriptor: an autoencoder 784 -> d -> 784, d up to 8, in an ONNX file, run
// by OpenCV. It takes images [n x 784], [n x 1 x 28 x 28] or [n x 28 x 28 x 1] and gives the reconstruction,
// 784 numbers in any shape. The position is its output of at most 8 numbers, where it has one, else what
// comes out of the narrowest layer (of equals the last, which is what the decoder reads).
#pragma once

#include <memory>
#include <string>

#include "models/descriptor/reconstructing_descriptor.h"

namespace hbr {

class OnnxDescriptor final : public ReconstructingDescriptor {
 public:
  // model: the content of an ONNX file; `where` leads the errors. Throws InputError where OpenCV can't read
  // it or it has not the shapes above.
  OnnxDescriptor(std::string model, const std::string& where);
  explicit OnnxDescriptor(const Hdf5Reader& file);
  ~OnnxDescriptor() override;

  // Positions are as the network gives them where those of the images [n x 784] all lie in [-1, 1]^d;
  // otherwise they are scaled so that they do. `raw` [n x d] are these images' positions without scaling.
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

}  // namespace hbr
