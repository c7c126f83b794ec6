// The trained network as others use it: batches, files.
#include "models/autoencoder/autoencoder.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "models/autoencoder/file.h"
#include "pipeline/core/check.h"
#include "tests/models/autoencoder/images.h"

namespace hbr {
namespace {

Autoencoder untrained(int latent, net::Activations activations = {0.1f}) {
  net::Network network(latent, activations);
  network.initialise(Seed(3), -2.f);
  return Autoencoder(std::move(network));
}

std::filesystem::path temporary(const char* name) { return std::filesystem::path(testing::TempDir()) / name; }

TEST(Autoencoder, AnImageIsDescribedWithoutRegardToItsNeighbours) {
  const Autoencoder autoencoder = untrained(2);
  constexpr int all = 70;
  const auto images = as_floats(stroke_images(all, Seed(1)));
  std::vector<float> alone(all * 2), alone_error(all), alone_decoded(all * 784);
  for (int i = 0; i < all; ++i) {
    const auto at = static_cast<std::size_t>(i);
    autoencoder.describe(1, &images[at * 784], &alone[at * 2], &alone_error[at]);
    autoencoder.decode(1, &alone[at * 2], &alone_decoded[at * 784]);
  }
  for (int n : {1, 2, 7, 15, 16, 17, 31, 32, 33, 48, 49, 70}) {
    const auto size = static_cast<std::size_t>(n);
    for (int first : {0, all - n}) {
      const auto begin = static_cast<std::size_t>(first);
      std::vector<float> latent(size * 2), error(size), encoded(size * 2), decoded(size * 784);
      autoencoder.describe(n, &images[begin * 784], latent.data(), error.data());
      autoencoder.encode(n, &images[begin * 784], encoded.data());
      autoencoder.decode(n, latent.data(), decoded.data());
      EXPECT_EQ(latent, encoded);
      // Bit for bit.
      EXPECT_TRUE(std::equal(latent.begin(), latent.end(), alone.begin() + 2 * first)) << n;
      EXPECT_TRUE(std::equal(error.begin(), error.end(), alone_error.begin() + first)) << n;
      EXPECT_TRUE(std::equal(decoded.begin(), decoded.end(), alone_decoded.begin() + 784 * first)) << n;
    }
  }
}

TEST(Autoencoder, BytesAndFloatsAreTheSameImages) {
  const Autoencoder autoencoder = untrained(3);
  constexpr int n = 20;
  const auto bytes = stroke_images(n, Seed(2));
  const auto images = as_floats(bytes);
  std::vector<const std::uint8_t*> rows;
  for (std::size_t i = 0; i < n; ++i) rows.push_back(&bytes[i * 784]);
  std::vector<float> latent(n * 3), error(n), latent_of_bytes(n * 3), error_of_bytes(n);
  autoencoder.describe(n, images.data(), latent.data(), error.data());
  autoencoder.describe(n, rows.data(), latent_of_bytes.data(), error_of_bytes.data());
  EXPECT_EQ(latent, latent_of_bytes);
  EXPECT_EQ(error, error_of_bytes);
}

TEST(Autoencoder, NoImagesAreFine) {
  untrained(2).describe(0, static_cast<const float*>(nullptr), nullptr, nullptr);
}

TEST(Autoencoder, RangeIsTheHyperbolicTangents) {
  EXPECT_EQ(untrained(5).dimension(), 5);
  EXPECT_EQ(untrained(5).lower(), Eigen::VectorXf::Constant(5, -1.f));
  EXPECT_EQ(untrained(5).upper(), Eigen::VectorXf::Constant(5, 1.f));
}

TEST(AutoencoderFile, RoundTrip) {
  for (const auto& [latent, activations] : std::vector<std::pair<int, net::Activations>>{
           {1, {0.1f}}, {2, {.tanh_hidden = true}}, {8, {0.f, false, true}}}) {
    const Autoencoder written = untrained(latent, activations);
    const auto path = temporary("autoencoder_round_trip.h5");
    Hdf5Writer file(path);
    write_autoencoder(file, written);
    file.close();
    const Autoencoder read = load_autoencoder(path);
    EXPECT_EQ(read.network().parameters, written.network().parameters);
    EXPECT_EQ(read.network().deconv2_spectra, written.network().deconv2_spectra);
    EXPECT_EQ(read.network().activations, activations);
  }
}

TEST(AutoencoderFile, RefusesOtherShapesAndNumbers) {
  const auto path = temporary("autoencoder_bad.h5");
  const auto message = [&] {
    try {
      load_autoencoder(path);
      return std::string("accepted");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
  };
  net::Network network(2, {0.1f});
  network.parameters[static_cast<std::size_t>(network.layer(net::kDense2).kernel)] =
      std::numeric_limits<float>::quiet_NaN();
  {
    Hdf5Writer file(path);
    write_autoencoder(file, Autoencoder(network));
    file.close();
  }
  EXPECT_THAT(message(), testing::HasSubstr("weights/encoder_dense2/kernel: entry 0 is nan"));
  {
    Hdf5Writer file(path);
    file.attribute("latent_size", std::int64_t{2});
    file.attribute("leak", 0.1);
    file.attribute("hidden", std::string("leaky"));
    file.attribute("output", std::string("sigmoid"));
    const std::vector<float> kernel(648, 0.f);
    file.write("weights/encoder_conv1/kernel", {9, 9, 8, 1}, kernel.data());
    file.close();
  }
  EXPECT_THAT(message(), testing::HasSubstr("expected the shape 9 x 9 x 1 x 8, found 9 x 9 x 8 x 1"));
  {
    Hdf5Writer file(path);
    file.attribute("latent_size", std::int64_t{2});
    file.attribute("leak", 0.1);
    file.attribute("hidden", std::string("relu"));
    file.close();
  }
  EXPECT_THAT(message(), testing::HasSubstr("attribute hidden is 'relu', expected 'leaky' or 'tanh'"));
  {
    Hdf5Writer file(path);
    file.attribute("latent_size", std::int64_t{2000000000});
    file.attribute("leak", 0.1);
    file.attribute("hidden", std::string("leaky"));
    file.attribute("output", std::string("sigmoid"));
    file.close();
  }
  EXPECT_THAT(message(), testing::HasSubstr("latent_size is 2000000000, expected 1 to 8"));
}

}  // namespace
}  // namespace hbr
