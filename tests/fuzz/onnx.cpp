// A network from elsewhere: ONNX.
#include "models/autoencoder/autoencoder.h"
#include "models/onnx/graph.h"
#include "models/onnx/onnx_descriptor.h"
#include "tests/fuzz/fuzz.h"

namespace hbr::fuzz {

std::vector<std::string> examples() {
  const std::vector<float> weights(2 * 784, 0.01f);
  std::vector<std::string> all;
  for (const bool layers : {false, true}) {
    OnnxGraph graph;
    graph.input("x", {784});
    graph.weights("w1", {784, 2}, weights);
    graph.weights("w2", {2, 784}, weights);
    graph.node("MatMul", {"x", "w1"}, "h");
    graph.node("Tanh", {"h"}, "z");
    if (layers) {
      graph.numbers("shape", {-1, 1, 2});
      graph.node("Reshape", {"z", "shape"}, "r");
      graph.node("Flatten", {"r"}, "f", {{"axis", std::int64_t{1}}});
    }
    graph.node("MatMul", {layers ? "f" : "z", "w2"}, "y");
    graph.output("y", {784});
    all.push_back(graph.bytes());
  }
  return all;
}

void read(const std::string& bytes) {
  const OnnxDescriptor descriptor(bytes, "network.onnx");
  const std::vector<float> image(784, 0.5f);
  std::vector<float> position(static_cast<std::size_t>(descriptor.dimension())), decoded(784);
  descriptor.reconstruct(1, image.data(), position.data(), decoded.data());
}

}  // namespace hbr::fuzz
