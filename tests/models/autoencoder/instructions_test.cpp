// Fused multiply-adds, in the machine code and in a result: the network's kernels are written for them, and
// the search and the hierarchy must not have any, as their bytes are to be the same on every machine.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <regex>
#include <string>

#include "models/autoencoder/autoencoder.h"
#include "pipeline/artifact/toolchain.h"

namespace hbr {
namespace {

#if defined(__FMA__) || defined(__aarch64__)
constexpr bool kTargetFuses = true;
#else
constexpr bool kTargetFuses = false;
#endif

// Compilers fuse nothing where they are asked to optimise less than for a release.
bool fuses() {
  const std::string flags = toolchain().at("flags");
  return kTargetFuses && flags.find("-O3") != std::string::npos;
}

struct Instructions {
  int fused = 0, multiplications = 0;  // of floats, in vectors or alone
};

// Of a library as it was built, or of those of its objects whose names begin so.
Instructions instructions_of(const std::string& library, const std::string& object = "") {
  const std::string command = "objdump -d --no-show-raw-insn '" HBR_BINARY_DIR "/" + library + "'";
  const std::unique_ptr<FILE, int (*)(FILE*)> text(popen(command.c_str(), "r"), pclose);
  static const std::regex fused("vfn?m(add|sub)[0-9]|\\bfn?m(add|sub)\\s|\\bfml[as]\\s"),
      multiplication("\\bv?mul[ps][sd]\\s|\\bfmul\\s");
  Instructions found;
  bool counts = object.empty();
  std::array<char, 4096> line;
  while (std::fgets(line.data(), line.size(), text.get())) {
    if (!object.empty() && std::strstr(line.data(), "file format"))
      counts = std::string(line.data()).starts_with(object);
    if (!counts) continue;
    found.fused += std::regex_search(line.data(), fused);
    found.multiplications += std::regex_search(line.data(), multiplication);
  }
  return found;
}

TEST(Instructions, KernelsAreFusedWhereTheTargetCan) {
  for (const char* object : {"forward.cpp", "backward.cpp", "conv1.cpp", "dense_gradient.cpp"}) {
    const Instructions found = instructions_of("models/autoencoder/libhbr_autoencoder.a", object);
    if (fuses()) {
      EXPECT_GT(found.fused, 50) << object;
      EXPECT_GT(found.fused, found.multiplications) << object;
    } else {
      EXPECT_EQ(found.fused, 0) << object;
      EXPECT_GT(found.multiplications, 0) << object;
    }
  }
}

TEST(Instructions, NothingIsFusedWhereBytesAreTheSameEverywhere) {
  int multiplications = 0;
  for (const char* library :
       {"pipeline/core/libhbr_core.a", "pipeline/qd/libhbr_qd.a", "pipeline/drawing/libhbr_drawing.a",
        "pipeline/hierarchy/libhbr_hierarchy.a", "models/arm/libhbr_arm.a"}) {
    const Instructions found = instructions_of(library);
    EXPECT_EQ(found.fused, 0) << library;
    multiplications += found.multiplications;
  }
  EXPECT_GT(multiplications, 500);  // there was something to fuse
}

// Built by GCC 12 for AVX2 this product was seen not to be fused, though most of the kernels' are (above):
// there the result says nothing.
#if defined(__AVX512F__) || !defined(__FMA__)
// 2^20 (1 + 2^-12)^2 = 2^20 (1 + 2^-11) + 2^-4. As a float of its own the product loses the last term, which
// is all that is left when the bias takes the first away.
TEST(Instructions, ProductsKeepTheirLastBitsWhereTheTargetFuses) {
  net::Network network(1, {0.1f});
  std::fill(network.parameters.begin(), network.parameters.end(), 0.f);
  const float factor = 1024.f * (1 + 0x1p-12f);
  network.parameters[static_cast<std::size_t>(network.layer(net::kDense2).bias)] = factor;
  const net::Layer& latent = network.layer(net::kLatent);
  network.parameters[static_cast<std::size_t>(latent.kernel)] = factor;
  network.parameters[static_cast<std::size_t>(latent.bias)] = -0x1p20f * (1 + 0x1p-11f);
  network.refresh();
  const Autoencoder autoencoder(network);
  const std::array<float, 784> image{};
  float position = 0, error = 0;
  autoencoder.describe(1, image.data(), &position, &error);
  EXPECT_NEAR(position, fuses() ? std::tanh(0x1p-4) : 0, 1e-6);
}
#endif

}  // namespace
}  // namespace hbr
