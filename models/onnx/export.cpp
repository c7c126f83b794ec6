#include "models/onnx/export.h"

#include "models/onnx/graph.h"

namespace hbr::inline onnx {
namespace {

using net::Index;
using net::Layer;
using net::LayerIndex;

constexpr Index kPlace = 7 * 7;  // pixels of the maps between convolutions and dense layers

// What the files say of their inputs and outputs.
constexpr const char *kImage =
                         "images n x 1 x 28 x 28 (image, channel, row from the top, column), float32, "
                         "from 0 (black, no ink) to 1 (white, ink)",
                     *kPosition = "places n x d in the latent space, float32, each coordinate from -1 to 1",
                     *kDecoded = "reconstructions n x 1 x 28 x 28 of the images, float32, from 0 to 1",
                     *kLinearlyDecoded =
                         "reconstructions n x 1 x 28 x 28 of the images, float32, about 0 to 1";

// ONNX flattens maps channel by channel, our network pixel by pixel.
Index flat_in_onnx(Index i) { return i % net::kMaps * kPlace + i / net::kMaps; }

class Exporter {
 public:
  explicit Exporter(const net::Network& network) : network_(network) {}

  void encoder() {
    graph_.input("image", {1, net::kSide, net::kSide}, kImage);
    convolution(net::kConv1, "image");
    pool(activated());
    convolution(net::kConv2, last_);
    pool(activated());
    add("Flatten", {last_}, "flat", {{"axis", std::int64_t{1}}});
    dense(net::kDense1, last_);
    dense(net::kDense2, activated());
    dense(net::kLatent, activated());
    add("Tanh", {last_}, "position");
    graph_.output("position", {network_.layout.latent_size}, kPosition);
  }

  void decoder() {
    dense(net::kDense3, "position");
    dense(net::kDense4, activated());
    dense(net::kDense5, activated());
    graph_.numbers("maps", {-1, net::kMaps, 7, 7});
    add("Reshape", {activated(), "maps"}, "seeds");
    graph_.weights("twice", {4}, {1, 1, 2, 2});
    convolution(net::kDeconv1, last_);
    unpool(activated());
    convolution(net::kDeconv2, last_);
    unpool(activated());
    convolution(net::kOutput, last_);
    const bool linear = network_.activations.linear_output;
    add(linear ? "Identity" : "Sigmoid", {last_}, "decoded");
    graph_.output("decoded", {1, net::kSide, net::kSide}, linear ? kLinearlyDecoded : kDecoded);
  }

  void decoder_alone() {
    graph_.input("position", {network_.layout.latent_size}, kPosition);
    decoder();
  }

  std::string bytes(const std::string& description) {
    graph_.remark("description", description);
    graph_.remark("image", kImage);
    graph_.remark("position", kPosition);
    graph_.remark("decoded", kDecoded);
    return graph_.bytes();
  }

 private:
  void add(const std::string& operation, const std::vector<std::string>& inputs, const std::string& output,
           const std::vector<OnnxAttribute>& attributes = {}) {
    graph_.node(operation, inputs, output, attributes);
    last_ = output;
  }

  void convolution(LayerIndex i, const std::string& input) {
    const Layer& l = network_.layer(i);
    const std::int64_t side = static_cast<std::int64_t>(l.shape[0]);
    const Index taps = side * side, inputs = l.inputs / taps, outputs = l.outputs;
    std::vector<float> kernel;  // [outputs][inputs][row][column]
    for (Index o = 0; o < outputs; ++o)
      for (Index c = 0; c < inputs; ++c)
        for (Index tap = 0; tap < taps; ++tap)
          kernel.push_back(network_.kernel(i)[(tap * inputs + c) * outputs + o]);
    graph_.weights(l.name + "/kernel", {outputs, inputs, side, side}, kernel);
    graph_.weights(l.name + "/bias", {outputs}, {network_.bias(i), network_.bias(i) + outputs});
    const std::vector<std::int64_t> borders(4, side / 2), sides(2, side);
    add("Conv", {input, l.name + "/kernel", l.name + "/bias"}, l.name,
        {{"kernel_shape", sides}, {"pads", borders}});
  }

  void dense(LayerIndex i, const std::string& input) {
    const Layer& l = network_.layer(i);
    const bool from_maps = i == net::kDense1, to_maps = i == net::kDense5;
    std::vector<float> kernel(static_cast<std::size_t>(l.inputs * l.outputs));  // [outputs][inputs]
    std::vector<float> bias(static_cast<std::size_t>(l.outputs));
    for (Index o = 0; o < l.outputs; ++o) {
      const Index row = to_maps ? flat_in_onnx(o) : o;
      bias[static_cast<std::size_t>(row)] = network_.bias(i)[o];
      for (Index k = 0; k < l.inputs; ++k)
        kernel[static_cast<std::size_t>(row * l.inputs + (from_maps ? flat_in_onnx(k) : k))] =
            network_.kernel(i)[k * l.stride + o];
    }
    graph_.weights(l.name + "/kernel", {l.outputs, l.inputs}, kernel);
    graph_.weights(l.name + "/bias", {l.outputs}, bias);
    add("Gemm", {input, l.name + "/kernel", l.name + "/bias"}, l.name, {{"transB", std::int64_t{1}}});
  }

  std::string activated() {
    if (network_.activations.tanh_hidden)
      add("Tanh", {last_}, last_ + "/activated");
    else
      add("LeakyRelu", {last_}, last_ + "/activated", {{"alpha", network_.activations.leak}});
    return last_;
  }

  void pool(const std::string& input) {
    const std::vector<std::int64_t> two{2, 2};
    add("MaxPool", {input}, input + "/pooled", {{"kernel_shape", two}, {"strides", two}});
  }

  void unpool(const std::string& input) {
    add("Resize", {input, "", "twice"}, input + "/unpooled",
        {{"mode", "nearest"}, {"coordinate_transformation_mode", "asymmetric"}, {"nearest_mode", "floor"}});
  }

  const net::Network& network_;
  OnnxGraph graph_;
  std::string last_;  // the value made last
};

}  // namespace

std::string onnx_encoder(const net::Network& network) {
  Exporter exporter(network);
  exporter.encoder();
  return exporter.bytes("encoder of an autoencoder: image to position");
}

std::string onnx_decoder(const net::Network& network) {
  Exporter exporter(network);
  exporter.decoder_alone();
  return exporter.bytes("decoder of an autoencoder: position to decoded");
}

std::string onnx_whole(const net::Network& network) {
  Exporter exporter(network);
  exporter.encoder();
  exporter.decoder();
  return exporter.bytes("autoencoder: image to position and decoded");
}

}  // namespace hbr::inline onnx
