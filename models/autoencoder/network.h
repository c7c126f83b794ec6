// The paper's network (appendix): layers, where their parameters lie, and the forms of them that the kernels
// read.
//
//   encoder  CV(8,9c1s) - maxpool - CV(8,3c1s) - maxpool - FC(100, 100, d), tanh
//   decoder  FC(100, 100, 392) - DC(8,3c1s) - unpool - DC(8,9c1s) - unpool - CV(1,3c1s), sigmoid or none
//
// Leaky rectifiers (or tanh) elsewhere, all convolutions with stride 1 and zero borders. A "deconvolution" of
// stride 1 is a convolution with its kernel turned round, so DC layers are trained as convolutions. Unpooling
// doubles rows and columns (nearest neighbour).
#pragma once

#include <tbb/cache_aligned_allocator.h>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "pipeline/core/random.h"

namespace hbr::net {

using Index = std::ptrdiff_t;
using Floats = std::vector<float, tbb::cache_aligned_allocator<float>>;

inline constexpr int kSide = 28;
inline constexpr int kPixels = kSide * kSide;
inline constexpr int kMaps = 8;              // feature maps of every convolution but the last
inline constexpr int kFlat = 7 * 7 * kMaps;  // what the convolutions hand to the dense layers, and back
inline constexpr int kHidden = 100;
inline constexpr int kMaxLatent = 8;

enum LayerIndex {
  kConv1,
  kConv2,
  kDense1,
  kDense2,
  kLatent,
  kDense3,
  kDense4,
  kDense5,
  kDeconv1,
  kDeconv2,
  kOutput
};
inline constexpr int kLayers = 11;

// Numbers of a row of n with the zeros that fill its last vector, however wide vectors are.
constexpr Index padded(Index n) { return (n + 15) / 16 * 16; }

struct Layer {
  std::string name;                // in files: "weights/NAME/kernel", "weights/NAME/bias"
  std::vector<std::size_t> shape;  // of the kernel: {rows, columns, inputs, outputs} or {inputs, outputs}
  Index inputs = 0;                // weights that lead to one output
  Index outputs = 0;
  Index stride = 0;  // from one input's weights to the next one's: dense rows are padded with zeros
  Index kernel = 0;  // offsets into the parameters
  Index bias = 0;
};

struct Layout {
  explicit Layout(int latent_size);

  int latent_size;
  std::array<Layer, kLayers> layers;
  Index size = 0;  // parameters with padding
};

// Convolutions that follow an unpooling, as one convolution of the small grid with four times the outputs,
// one set per output parity (row, column), which is exact: of a 9 x 9 kernel each parity sees 5 x 5 small
// pixels, of a 3 x 3 kernel 2 x 2 of 3 x 3. Shapes {rows, columns, inputs, parity, outputs}.
inline constexpr int kSubpixelOutput = 3 * 3 * kMaps * 4;
inline constexpr int kSubpixelDeconv2 = 5 * 5 * kMaps * 4 * kMaps;

// Adds the kernel [size x size x inputs x outputs] up to its sub-pixel form, which starts at zero.
void to_subpixel(int size, int inputs, int outputs, const float* kernel, float* subpixel);
// The transposed map, for gradients: adds to `kernel`.
void from_subpixel(int size, int inputs, int outputs, const float* subpixel, float* kernel);

// What the paper does not say of the units: those between the layers are leaky rectifiers, whose slope below
// zero is `leak`, or tanh; the output's are sigmoids, or linear.
struct Activations {
  float leak = 0;
  bool tanh_hidden = false;
  bool linear_output = false;
  bool operator==(const Activations&) const = default;
};

// Parameters and, for the kernels, their derived forms.
class Network {
 public:
  Network(int latent_size, Activations activations);

  // Uniform with the variance that keeps the scale of signals: He for rectified layers, Glorot for the
  // latent, the output and tanh; biases 0 but the output's, which starts at `output_bias` (about the logit of
  // the mean brightness; from 0 most initialisations collapse to the mean image).
  void initialise(Seed seed, float output_bias);
  // To be called when the parameters have changed.
  void refresh();

  const Layer& layer(LayerIndex i) const { return layout.layers[i]; }
  const float* kernel(LayerIndex i) const { return parameters.data() + layout.layers[i].kernel; }
  const float* bias(LayerIndex i) const { return parameters.data() + layout.layers[i].bias; }

  Layout layout;
  Activations activations;
  Floats parameters;
  Floats conv1_spread;              // conv1.h
  Floats deconv2_spectra;           // of the sub-pixel form (fourier.h), so that its results need no factor
  Floats output;                    // sub-pixel form
  Floats output_bias;               // of the four parities
  Floats conv2_back, deconv1_back;  // turned round, inputs and outputs swapped
  Floats output_back;  // {4, 4, inputs}: from a window of output pixels to the small pixel in its middle
};

}  // namespace hbr::net
