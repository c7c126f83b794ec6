// A descriptor in place of the autoencoder, the same for all replications: a network trained elsewhere, or
// components of the training images (the paper's section 5.1 names kernel PCA as future work).
#include <fmt/ranges.h>

#include <fstream>
#include <iterator>
#include <memory>
#include <numeric>

#include "models/descriptor/pca.h"
#include "models/onnx/onnx_descriptor.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/core/check.h"
#include "pipeline/core/file_error.h"
#include "pipeline/core/parallel.h"
#include "stages/learned/descriptor_evidence.h"
#include "stages/learned/descriptor_settings.h"

namespace hbr::inline stages {
namespace {

constexpr std::size_t kGrain = 256;

std::string content(const std::string& path) {
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw file_error(path, "can't read this ONNX network ([descriptor] file)", errno);
  return {std::istreambuf_iterator<char>(stream), {}};
}

Rows places_of(const OnnxDescriptor& network, const LabelledImages& half, Workers& workers) {
  Rows places(static_cast<Eigen::Index>(half.size()), network.dimension());
  workers.for_ranges(half.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    const Rows images = as_images({half.image(begin), half.image(end - 1) + kImagePixels});
    Rows decoded(images.rows(), images.cols());
    network.reconstruct(images.rows(), images.data(), places.row(static_cast<Eigen::Index>(begin)).data(),
                        decoded.data());
  });
  return places;
}

// What was read of the network, for whoever knows it.
void tell(const std::string& stage, const std::string& file, const OnnxSettings& found) {
  fmt::print(stderr, "{}: {}: position '{}', reconstruction '{}', images of {}\n", stage, file,
             found.position, found.reconstruction, fmt::join(found.input_shape, " x "));
}

std::unique_ptr<ReconstructingDescriptor> make(const std::string& stage, const DescriptorSlice& s,
                                               const LabelledImages& train, Workers& workers) {
  if (s.kind == "pca") return std::make_unique<PrincipalComponents>(train.images, s.latent_size);
  if (s.kind == "kernel_pca") return std::make_unique<KernelPca>(s.kernel_pca, train.images, s.latent_size);
  auto network = std::make_unique<OnnxDescriptor>(content(s.file), s.file, s.onnx);
  tell(stage, s.file, network->settings());
  network->place(places_of(*network, train, workers));
  return network;
}

// The mean squared error of the best that is the same for all images: their mean.
double error_of_mean(const LabelledImages& images) {
  const auto n = static_cast<Eigen::Index>(images.size());
  const Eigen::MatrixXd pixels = as_images(images.images).cast<double>();
  return (pixels.squaredNorm() - static_cast<double>(n) * pixels.colwise().mean().squaredNorm()) /
         static_cast<double>(pixels.size());
}

// Returns the mean squared error over the test images.
double write_evidence(Hdf5Writer& file, const ReconstructingDescriptor& descriptor,
                      const LabelledImages& test, Workers& workers) {
  const auto dim = static_cast<std::size_t>(descriptor.dimension());
  const std::vector<float> images = as_floats(test.images);
  std::vector<float> position(test.size() * dim), error(test.size());
  workers.for_ranges(test.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    descriptor.describe(static_cast<Eigen::Index>(end - begin), &images[begin * kImagePixels],
                        &position[begin * dim], &error[begin]);
  });
  const double test_error =
      std::accumulate(error.begin(), error.end(), 0.) / static_cast<double>(error.size());
  file.attribute("test_error", test_error);
  write_latent(file, test, position);
  write_examples(file, test, [&](Eigen::Index n, const float* from, float* decoded) {
    std::vector<float> places(static_cast<std::size_t>(n) * dim);
    descriptor.reconstruct(n, from, places.data(), decoded);
  });
  return test_error;
}

void run(StageRun& stage) {
  const Dataset dataset = read_dataset(stage.input("dataset"));
  Workers workers(stage.threads());
  const auto descriptor = make(stage.name(), stage.settings_as<DescriptorSlice>(), dataset.train, workers);
  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  descriptor->write(file);
  const double error = write_evidence(file, *descriptor, dataset.test, workers);
  file.close();
  if (const double mean = error_of_mean(dataset.test); error > mean)
    fmt::print(stderr,
               "{}: odd: test images are reconstructed worse (mean squared error {:.3g}) than by their mean "
               "({:.3g}); of a network, see input_range and reconstruction_range, and whether it ends as it "
               "was trained (a sigmoid left out?)\n",
               stage.name(), error, mean);
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "Descriptor: a network from elsewhere, or components", hbr::run);
}
