// Rates of one thread, per CPU second, beside what the core could do and what plain loops do. "of_peak" is
// the share of the measured peak that the executed operations reach: multiply-adds counted without border
// taps and in sub-pixel form, as if every pixel were lit.
#include <benchmark/benchmark.h>

#include <chrono>

#include "models/autoencoder/adam.h"
#include "models/autoencoder/autoencoder.h"
#include "models/autoencoder/gradient.h"
#include "models/autoencoder/lanes.h"
#include "tests/models/autoencoder/images.h"
#include "tests/models/autoencoder/reference.h"

namespace hbr {
namespace {

// Multiply-adds of one image, forward. Convolutions: valid taps of all pixels x inputs x outputs.
constexpr double valid(int size, int taps) {
  const int half = taps / 2, line = size * taps - half * (half + 1);
  return static_cast<double>(line) * line;
}
constexpr double kConv1 = valid(28, 9) * 8;
constexpr double kForward = kConv1 + valid(14, 3) * 64 + valid(7, 3) * 64 + valid(7, 5) * 256 +
                            valid(28, 3) * 8 * 4 / 9 + 2. * (392 * 100 + 100 * 100 + 100 * 2);
// Forward, gradients of inputs (not of the image) and of weights.
constexpr double kTraining = 3 * kForward - kConv1;

// Fused multiply-adds in enough chains to fill the core's units.
double peak_operations(double seconds) {
  using net::Lanes;
  constexpr int chains = 12, rounds = 100000;
  Lanes sum[chains];
  for (int c = 0; c < chains; ++c) sum[c] = net::broadcast(1.f + 0.01f * static_cast<float>(c));
  const Lanes factor = net::broadcast(0.999f), offset = net::broadcast(0.001f);
  double best = 0;
  const auto start = std::chrono::steady_clock::now();
  while (std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() < seconds) {
    const auto begin = std::chrono::steady_clock::now();
    for (int r = 0; r < rounds; ++r)
#pragma GCC unroll 12
      for (int c = 0; c < chains; ++c) sum[c] = sum[c] * factor + offset;
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - begin;
    best = std::max(best, static_cast<double>(chains) * rounds * net::kLanes / time.count());
  }
  benchmark::DoNotOptimize(sum);
  return best;
}

double peak() {
  static const double measured = peak_operations(0.5);
  return measured;
}

void report(benchmark::State& state, double images, double operations) {
  state.SetItemsProcessed(static_cast<std::int64_t>(images));
  state.counters["of_peak"] = benchmark::Counter(images * operations / peak(), benchmark::Counter::kIsRate);
}

void Peak(benchmark::State& state) {
  for (auto _ : state) state.counters["multiply_adds"] = peak_operations(0.5);
}
BENCHMARK(Peak)->Iterations(1)->Unit(benchmark::kMillisecond);

net::Network network() {
  net::Network n(2, {0.1f});
  n.initialise(Seed(1), -2.f);
  return n;
}

std::vector<const std::uint8_t*> rows_of(const std::vector<std::uint8_t>& images) {
  std::vector<const std::uint8_t*> rows;
  for (std::size_t i = 0; i < images.size(); i += 784) rows.push_back(&images[i]);
  return rows;
}

// Images without a black pixel: the skipping of unlit columns gains nothing.
std::vector<std::uint8_t> lit_images(int n) {
  std::vector<std::uint8_t> images(static_cast<std::size_t>(n) * 784);
  Rng rng{Seed(1)};
  for (auto& p : images) p = static_cast<std::uint8_t>(1 + rng.below(255));
  return images;
}

void train(benchmark::State& state, const std::vector<std::uint8_t>& images, int threads = 1) {
  net::Network net = network();
  net::Adam adam(net.parameters.size());
  net::BatchGradient gradient(net.layout);
  Workers workers(threads);
  const auto rows = rows_of(images);
  for (auto _ : state) {
    gradient.find(net, static_cast<int>(rows.size()), rows.data(), 1.f / 128, workers);
    adam.step(1e-3, gradient.gradient(), net.parameters, workers);
    net.refresh();
  }
  report(state, static_cast<double>(state.iterations()) * static_cast<double>(rows.size()), kTraining);
}

void TrainDigits(benchmark::State& state) { train(state, digit_images(128, Seed(1))); }
void TrainLit(benchmark::State& state) { train(state, lit_images(128)); }
void TrainThreads(benchmark::State& state) {
  train(state, digit_images(128, Seed(1)), static_cast<int>(state.range(0)));
}
BENCHMARK(TrainThreads)->Arg(1)->Arg(2)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(TrainDigits)->Unit(benchmark::kMillisecond);
BENCHMARK(TrainLit)->Unit(benchmark::kMillisecond);

void describe(benchmark::State& state, const std::vector<std::uint8_t>& bytes) {
  const Autoencoder autoencoder(network());
  const auto images = as_floats(bytes);
  const auto n = bytes.size() / 784;
  std::vector<float> latent(n * 2), error(n);
  for (auto _ : state)
    autoencoder.describe(static_cast<Eigen::Index>(n), images.data(), latent.data(), error.data());
  report(state, static_cast<double>(state.iterations()) * static_cast<double>(n), kForward);
}

void DescribeDigits(benchmark::State& state) {
  describe(state, digit_images(static_cast<int>(state.range(0)), Seed(1)));
}
void DescribeLit(benchmark::State& state) { describe(state, lit_images(static_cast<int>(state.range(0)))); }
BENCHMARK(DescribeDigits)->Arg(200)->Arg(1)->Unit(benchmark::kMillisecond);
BENCHMARK(DescribeLit)->Arg(200)->Unit(benchmark::kMillisecond);

void DescribeByPlainLoops(benchmark::State& state) {
  const net::Network net = network();
  const std::vector<double> parameters(net.parameters.begin(), net.parameters.end());
  const auto image = as_floats(digit_images(1, Seed(1)));
  const reference::Maps maps(image.begin(), image.end());
  for (auto _ : state)
    benchmark::DoNotOptimize(reference::describe(net.layout, net.activations, parameters.data(), maps).error);
  report(state, static_cast<double>(state.iterations()), kForward);
}
BENCHMARK(DescribeByPlainLoops)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace hbr
