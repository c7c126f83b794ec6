// A network from elsewhere: ONNX, with and without weights in a file beside it.
#include "models/onnx/onnx_descriptor.h"
#include "models/onnx/trial.h"
#include "tests/fuzz/fuzz.h"
#include "tests/models/onnx/other_writer.h"

namespace hbr::fuzz {
namespace {

constexpr int kWeights = 2 * 784;

}  // namespace

std::vector<std::string> examples() {
  std::vector<std::string> all;
  for (const std::string& data : {other::raw_data(other::raw(std::vector<float>(kWeights, 0.01f))),
                                  other::in_file("weights", "8", "6272"), other::in_file("weights", "", "")})
    for (const bool layers : {false, true}) {
      other::File file;
      file.input("x", {-1, 784})
          .weights(other::tensor("w1", other::kFloat, {784, 2}, data))
          .weights(
              other::tensor("w2", other::kFloat16, {2, 784}, other::raw_data(std::string(2 * kWeights, '0'))))
          .node("MatMul", {"x", "w1"}, {"h"})
          .node("Tanh", {"h"}, {"z"});
      if (layers)
        file.weights(other::tensor("shape", other::kInt64, {3},
                                   other::raw_data(other::raw<std::int64_t>({-1, 1, 2}))))
            .node("Reshape", {"z", "shape"}, {"r"})
            .node("Flatten", {"r"}, {"f"}, other::integer_attribute("axis", 1));
      file.node("MatMul", {layers ? "f" : "z", "w2"}, {"y"}).output("y", {-1, 784});
      all.push_back(file.content());
    }
  return all;
}

void read(const std::string& bytes) {
  and_go_on([&] { understood("network", bytes, {"z", "y"}); });  // what the other process may say astray
  written("weights", std::string(8 + kWeights * sizeof(float), '0'));
  const OnnxDescriptor descriptor(bytes, folder() / "network.onnx");
  const std::vector<float> image(784, 0.5f);
  std::vector<float> position(static_cast<std::size_t>(descriptor.dimension())), decoded(784);
  descriptor.reconstruct(1, image.data(), position.data(), decoded.data());
}

}  // namespace hbr::fuzz
