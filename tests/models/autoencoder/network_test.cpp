// The kernels against the loops of reference.h: forward to float rounding, gradients against central
// differences of the reference in double.
#include "models/autoencoder/network.h"

#include <gmock/gmock.h>

#include <set>

#include "models/autoencoder/autoencoder.h"
#include "models/autoencoder/gradient.h"
#include "tests/models/autoencoder/images.h"
#include "tests/models/autoencoder/reference.h"

namespace hbr {
namespace {

net::Network random_network(int latent, net::Activations activations, std::uint64_t seed) {
  net::Network network(latent, activations);
  network.initialise(Seed(seed), -2.f);
  // Biases away from zero, so that their place matters.
  Rng rng(Seed(seed).child("bias"));
  for (const net::Layer& l : network.layout.layers)
    for (net::Index o = 0; o < l.outputs; ++o)
      network.parameters[static_cast<std::size_t>(l.bias + o)] += rng.uniform(-0.2f, 0.2f);
  network.refresh();
  return network;
}

constexpr net::Activations kActivations[] = {
    {0}, {0.1f}, {.tanh_hidden = true}, {.leak = 0.1f, .linear_output = true}};

std::vector<double> doubles(const net::Floats& x) { return {x.begin(), x.end()}; }

reference::Maps image_of(const std::vector<float>& images, int i) {
  return {images.begin() + i * 784, images.begin() + (i + 1) * 784};
}

TEST(Network, ForwardAgreesWithTheReference) {
  for (int latent : {1, 2, 3, 8})
    for (const net::Activations& activations : kActivations) {
      const net::Network network = random_network(latent, activations, 7);
      const auto p = doubles(network.parameters);
      constexpr int n = 19;
      auto images = as_floats(stroke_images(n, Seed(1)));
      Rng rng{Seed(2)};
      for (std::size_t i = 0; i < 784; ++i) images[i] = rng.uniform();  // no black pixel at all
      std::fill_n(images.begin() + 784, 784, 0.f);                      // nothing but black
      const Autoencoder autoencoder(network);
      std::vector<float> position(static_cast<std::size_t>(n * latent)), error(n), decoded(n * 784);
      autoencoder.describe(n, images.data(), position.data(), error.data());
      autoencoder.decode(n, position.data(), decoded.data());
      for (int i = 0; i < n; ++i) {
        const auto expected = reference::describe(network.layout, activations, p.data(), image_of(images, i));
        for (int d = 0; d < latent; ++d)
          EXPECT_NEAR(position[static_cast<std::size_t>(i * latent + d)],
                      expected.latent[static_cast<std::size_t>(d)], 3e-6);
        for (std::size_t k = 0; k < 784; ++k)
          ASSERT_NEAR(decoded[static_cast<std::size_t>(i) * 784 + k], expected.decoded[k], 4e-6);
        EXPECT_NEAR(error[static_cast<std::size_t>(i)], expected.error, 2e-6 * std::max(1.0, expected.error));
      }
    }
}

// He et al. 2015: variance 2 / ((1 + leak^2) inputs) before a leaky rectifier; Glorot and Bengio 2010: 1 /
// inputs elsewhere.
class Start : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(LeakyOrTanh, Start, testing::Bool());
TEST_P(Start, KeepsTheSizeOfSignals) {
  net::Network network(2, {0.1f, GetParam()});
  network.initialise(Seed(8), -1.5f);
  std::set<float> first;
  for (std::size_t l = 0; l < network.layout.layers.size(); ++l) {
    const net::Layer& layer = network.layout.layers[l];
    const bool plain = l == net::kLatent || l == net::kOutput || GetParam();
    const double expected = (plain ? 1 : 2 / 1.01) / static_cast<double>(layer.inputs);
    double squares = 0, n = 0;
    for (net::Index i = 0; i < layer.inputs; ++i)
      for (net::Index o = 0; o < layer.outputs; ++o, ++n)
        squares +=
            std::pow(network.parameters[static_cast<std::size_t>(layer.kernel + i * layer.stride + o)], 2);
    // A uniform square's variance is 4/5 of its squared mean.
    EXPECT_NEAR(squares / n / expected, 1, 5 * std::sqrt(0.8 / n)) << layer.name;
    first.insert(network.parameters[static_cast<std::size_t>(layer.kernel)] /
                 static_cast<float>(std::sqrt(expected)));
    for (net::Index o = 0; o < layer.outputs; ++o)
      EXPECT_EQ(network.parameters[static_cast<std::size_t>(layer.bias + o)],
                l == net::kOutput ? -1.5f : 0.f);
  }
  EXPECT_EQ(first.size(), network.layout.layers.size());  // no two layers with the same numbers
}

TEST(Network, SubpixelConvolutionIsUnpoolingThenConvolution) {
  for (int taps : {3, 5, 9}) {
    constexpr int in = 8, out = 2, small = 7;
    Rng rng{Seed(3)};
    net::Layer layer{.name = "",
                     .shape = {static_cast<std::size_t>(taps), static_cast<std::size_t>(taps), in, out}};
    std::vector<float> kernel(static_cast<std::size_t>(taps * taps * in * out));
    for (float& k : kernel) k = rng.uniform(-1, 1);
    layer.bias = static_cast<net::Index>(kernel.size());
    std::vector<double> parameters(kernel.begin(), kernel.end());
    parameters.resize(kernel.size() + out, 0.);
    reference::Maps maps(small * small * in);
    for (double& m : maps) m = rng.uniform(-1, 1);
    const auto expected =
        reference::convolve(layer, parameters.data(), reference::unpool(maps, small), 2 * small);

    const int half = (taps / 2 + 1) / 2, small_taps = 2 * half + 1;
    std::vector<float> sub(static_cast<std::size_t>(small_taps * small_taps * in * 4 * out), 0.f);
    net::to_subpixel(taps, in, out, kernel.data(), sub.data());
    net::Layer small_layer{
        .name = "",
        .shape = {static_cast<std::size_t>(small_taps), static_cast<std::size_t>(small_taps), in, 4 * out}};
    small_layer.bias = static_cast<net::Index>(sub.size());
    std::vector<double> small_parameters(sub.begin(), sub.end());
    small_parameters.resize(sub.size() + 4 * out, 0.);
    const auto found = reference::convolve(small_layer, small_parameters.data(), maps, small);
    for (int y = 0; y < 2 * small; ++y)
      for (int x = 0; x < 2 * small; ++x)
        for (int o = 0; o < out; ++o)
          ASSERT_NEAR(
              found[static_cast<std::size_t>(((y / 2 * small + x / 2) * 4 + y % 2 * 2 + x % 2) * out + o)],
              expected[static_cast<std::size_t>((y * 2 * small + x) * out + o)], 1e-5);
  }
}

TEST(Network, GradientsAgreeWithFiniteDifferences) {
  for (const net::Activations& activations : kActivations) {
    const net::Network network = random_network(activations.leak > 0 ? 2 : 5, activations, 11);
    constexpr int n = 3;  // fewer than any vector is wide
    const auto bytes = stroke_images(n, Seed(4));
    const auto images = as_floats(bytes);
    std::vector<const std::uint8_t*> rows;
    for (int i = 0; i < n; ++i) rows.push_back(bytes.data() + i * 784);
    net::BatchGradient gradient(network.layout);
    Workers workers(1);
    const double error = gradient.find(network, n, rows.data(), 1.f / n, workers);

    auto p = doubles(network.parameters);
    const auto loss = [&] {
      double sum = 0;
      for (int i = 0; i < n; ++i)
        sum +=
            reference::describe(network.layout, network.activations, p.data(), image_of(images, i)).error / n;
      return sum;
    };
    EXPECT_NEAR(error / n, loss(), 1e-6 * std::max(1.0, loss()));
    Rng rng{Seed(5)};
    for (const net::Layer& l : network.layout.layers) {
      double squares = 0, differences = 0;
      for (int k = 0; k < 6; ++k) {
        const bool bias = k >= 4;
        const net::Index i = bias ? l.bias + rng.below(static_cast<std::uint32_t>(l.outputs))
                                  : l.kernel + rng.below(static_cast<std::uint32_t>(l.inputs)) * l.stride +
                                        rng.below(static_cast<std::uint32_t>(l.outputs));
        const auto at = static_cast<std::size_t>(i);
        const double kept = p[at], step = 1e-6;
        p[at] = kept + step;
        const double above = loss();
        p[at] = kept - step;
        const double below = loss();
        p[at] = kept;
        const double expected = (above - below) / (2 * step), found = gradient.gradient()[at];
        squares += expected * expected;
        differences += (found - expected) * (found - expected);
        EXPECT_NEAR(found, expected, 1e-6 + 2e-3 * std::abs(expected))
            << l.name << " parameter " << i - l.kernel;
      }
      EXPECT_GT(squares, 0) << l.name;
      EXPECT_LT(std::sqrt(differences / squares), 2e-4) << l.name;
    }
  }
}

// More images than the groups that are worked out together have room for, lit up to their borders or not at
// all.
TEST(Network, ABatchsGradientIsTheSumOfItsImages) {
  const net::Network network = random_network(2, {0.1f}, 3);
  constexpr int n = 150;
  auto bytes = stroke_images(n, Seed(6));
  Rng rng{Seed(7)};
  for (int i = 0; i < 784; ++i)
    bytes[static_cast<std::size_t>(i)] = static_cast<std::uint8_t>(rng.below(256));
  for (const int corner : {0, 27, 27 * 28, 783}) bytes[static_cast<std::size_t>(784 + corner)] = 255;
  std::fill_n(bytes.begin() + 2 * 784, 784, std::uint8_t{0});
  std::vector<const std::uint8_t*> rows;
  for (int i = 0; i < n; ++i) rows.push_back(bytes.data() + i * 784);
  Workers workers(1);
  net::BatchGradient gradient(network.layout), single(network.layout);
  std::vector<double> sum(network.parameters.size());
  double error = 0;
  for (const std::uint8_t* image : rows) {
    error += single.find(network, 1, &image, 1, workers);
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += single.gradient()[i];
  }
  EXPECT_NEAR(gradient.find(network, n, rows.data(), 1, workers) / error, 1, 1e-6);
  double size = 0;
  for (double g : sum) size = std::max(size, std::abs(g));
  for (std::size_t i = 0; i < sum.size(); ++i) ASSERT_NEAR(gradient.gradient()[i], sum[i], 1e-5 * size) << i;
  for (const int threads : {2, 3, 8}) {
    Workers more(threads);
    net::BatchGradient again(network.layout);
    again.find(network, n, rows.data(), 1, more);
    EXPECT_TRUE(std::equal(again.gradient(), again.gradient() + sum.size(), gradient.gradient())) << threads;
  }
}

}  // namespace
}  // namespace hbr
