// Networks as other programs export them, and what they compute, by hand.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "models/onnx/onnx_descriptor.h"
#include "pipeline/core/check.h"
#include "pipeline/core/random.h"
#include "tests/models/autoencoder/images.h"
#include "tests/models/onnx/other_writer.h"

namespace hbr {

inline const Rows& some_images() {
  static const Rows all = as_images(stroke_images(6, Seed(5)));
  return all;
}

inline Rows random_matrix(Eigen::Index rows, Eigen::Index columns, const std::string& name, float size) {
  Rng rng{Seed(11).child(name)};
  Rows m(rows, columns);
  for (float& v : m.reshaped()) v = rng.uniform(-size, size);
  return m;
}

inline std::vector<float> numbers_of(const Rows& m) { return {m.data(), m.data() + m.size()}; }

// A dense layer, outputs x inputs, with a bias.
struct DenseLayer {
  DenseLayer(const std::string& name_, int inputs, int outputs, float size = 0.3f)
      : name(name_),
        w(random_matrix(outputs, inputs, name, size)),
        b(random_matrix(1, outputs, name + "b", 0.2f)) {}
  Rows of(const Rows& x) const { return (x * w.transpose()).rowwise() + b.row(0); }
  // Node and weights; how the weights are written may be another's.
  other::File& add(other::File& file, const std::string& from, const std::string& to) const {
    return file
        .weights(weights(name + ".weight", {static_cast<int>(w.rows()), static_cast<int>(w.cols())}, w))
        .weights(weights(name + ".bias", {static_cast<int>(w.rows())}, b))
        .node("Gemm", {from, name + ".weight", name + ".bias"}, {to}, other::integer_attribute("transB", 1));
  }
  using Write = std::function<std::string(const std::string&, const std::vector<int>&, const Rows&)>;
  std::string name;
  Rows w, b;
  Write weights = [](const std::string& n, const std::vector<int>& dims, const Rows& m) {
    return other::tensor(n, other::kFloat, dims, other::raw_data(other::raw(numbers_of(m))));
  };
};

inline Rows relu(const Rows& x) { return x.cwiseMax(0.f); }
inline Rows sigmoid(const Rows& x) { return (1 / (1 + (-x.array()).exp())).matrix(); }

// 784 -> 16 -> d -> 16 -> 784.
struct OtherAutoencoder {
  explicit OtherAutoencoder(int d)
      : in("in", 784, 16, 0.1f), code("code", 16, d), back("back", d, 16), out("out", 16, 784) {}
  Rows hidden(const Rows& x) const { return relu(in.of(x)); }
  Rows position(const Rows& x) const { return code.of(hidden(x)); }
  Rows decoded(const Rows& z) const { return sigmoid(out.of(relu(back.of(z)))); }
  void written_by(const DenseLayer::Write& write) {
    for (DenseLayer* layer : {&in, &code, &back, &out}) layer->weights = write;
  }
  // From images that are `from` on.
  other::File& encoder(other::File& file, const std::string& from = "flat") const {
    in.add(file, from, "h").node("Relu", {"h"}, {"hr"});
    return code.add(file, "hr", "z");
  }
  other::File& decoder(other::File& file, const std::string& from = "z") const {
    back.add(file, from, "g").node("Relu", {"g"}, {"gr"});
    return out.add(file, "gr", "o").node("Sigmoid", {"o"}, {"recon"}).output("recon", {-1, 784});
  }
  std::string content(const std::vector<int>& input, int type = other::kFloat) const {
    other::File file;
    file.input("image", input, type);
    file.node("Flatten", {"image"}, {"flat"}, other::integer_attribute("axis", 1));
    encoder(file);
    return decoder(file).content();
  }
  DenseLayer in, code, back, out;
};

struct Reconstructed {
  Rows position, decoded;
};
inline Reconstructed reconstructed(const OnnxDescriptor& network, const Rows& images) {
  Reconstructed r{Rows(images.rows(), network.dimension()), Rows(images.rows(), 784)};
  network.reconstruct(images.rows(), images.data(), r.position.data(), r.decoded.data());
  return r;
}

inline void expect_near(const Rows& found, const Rows& expected, float tolerance = 1e-4f) {
  ASSERT_EQ(found.rows(), expected.rows());
  ASSERT_EQ(found.cols(), expected.cols());
  EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), tolerance);
}

inline void expect_network(const OnnxDescriptor& network, const OtherAutoencoder& expected,
                           const Rows& images, float tolerance = 1e-4f) {
  const Reconstructed found = reconstructed(network, images);
  const Rows z = expected.position(images);
  expect_near(found.position, z, tolerance);
  expect_near(found.decoded, expected.decoded(z), tolerance);
}

// The one line that a network is refused with.
inline std::string complaint(const std::string& model, const OnnxSettings& settings = {},
                             const std::string& where = "mine.onnx") {
  try {
    const OnnxDescriptor network(model, where, settings);
    return "accepted: " + network.settings().position;
  } catch (const InputError& error) {
    const std::string line = error.what();
    EXPECT_EQ(line.find('\n'), std::string::npos) << line;
    EXPECT_EQ(line.rfind(where + ": ", 0), 0u) << line;
    return line;
  }
}

}  // namespace hbr
