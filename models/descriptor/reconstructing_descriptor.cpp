#include "models/descriptor/reconstructing_descriptor.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/drawing/draw.h"
#include "pipeline/qd/dimension.h"

namespace hbr::inline descriptor {
namespace {

constexpr Eigen::Index kDescribedTogether = 64;

}  // namespace

ReconstructingDescriptor::ReconstructingDescriptor(Eigen::Index dimension)
    : lower_(Eigen::VectorXf::Constant(dimension, -1.f)), upper_(Eigen::VectorXf::Constant(dimension, 1.f)) {
  HBR_CHECK(dimension >= 1 && dimension <= kMaxDescriptorSize, "dimension {}", dimension);
}

void ReconstructingDescriptor::describe(Eigen::Index n, const float* images, float* position,
                                        float* error) const {
  Rows decoded(std::min(n, kDescribedTogether), kImagePixels);
  for (Eigen::Index begin = 0; begin < n; begin += kDescribedTogether) {
    const Eigen::Index count = std::min(kDescribedTogether, n - begin);
    const float* from = images + begin * kImagePixels;
    float* place = position + begin * dimension();
    reconstruct(count, from, place, decoded.data());
    for (Eigen::Index i = 0; i < count; ++i) {
      error[begin + i] = (Eigen::Map<const Eigen::VectorXf>(from + i * kImagePixels, kImagePixels) -
                          Eigen::Map<const Eigen::VectorXf>(decoded.row(i).data(), kImagePixels))
                             .squaredNorm() /
                         kImagePixels;
      if (!std::isfinite(error[begin + i]))
        throw InputError(
            "the descriptor's reconstruction of an image is so far off that its error is {}; expected values "
            "about 0 to 1 (onnx: reconstruction_range)",
            error[begin + i]);
    }
    std::transform(place, place + count * dimension(), place,
                   [](float z) { return std::clamp(z, -1.f, 1.f); });
  }
}

Placement fill_unit_box(const Rows& raw) {
  const Eigen::VectorXf low = raw.colwise().minCoeff(), high = raw.colwise().maxCoeff();
  Placement placement{Eigen::VectorXf::Zero(raw.cols()), Eigen::VectorXf::Zero(raw.cols())};
  for (Eigen::Index d = 0; d < raw.cols(); ++d) {
    if (!(high[d] > low[d])) continue;
    placement.scale[d] = 2 / (high[d] - low[d]);
    placement.offset[d] = -1 - low[d] * placement.scale[d];
  }
  return placement;
}

Rows as_images(std::span<const std::uint8_t> bytes) {
  const auto n = static_cast<Eigen::Index>(bytes.size()) / kImagePixels;
  Rows images(n, kImagePixels);
  std::transform(bytes.begin(), bytes.end(), images.data(),
                 [](std::uint8_t b) { return static_cast<float>(b) / 255.f; });
  return images;
}

void write_matrix(Hdf5Writer& file, const std::string& name, const Rows& matrix) {
  file.write(name, {static_cast<std::size_t>(matrix.rows()), static_cast<std::size_t>(matrix.cols())},
             matrix.data());
}

Rows read_matrix(const Hdf5Reader& file, const std::string& name, Eigen::Index rows, Eigen::Index columns) {
  const Array<float> array = file.read<float>(name);
  const auto fits = [&](std::size_t axis, Eigen::Index size) {
    return size < 0 || array.shape[axis] == static_cast<std::size_t>(size);
  };
  if (array.shape.size() != 2 || !fits(0, rows) || !fits(1, columns))
    throw InputError("{}: {}: expected the shape {} x {}", file.path().string(), name,
                     rows < 0 ? "n" : std::to_string(rows), columns);
  const Rows matrix =
      Eigen::Map<const Rows>(array.values.data(), static_cast<Eigen::Index>(array.shape[0]), columns);
  if (!matrix.allFinite())
    throw InputError("{}: {} holds what is not a finite number", file.path().string(), name);
  return matrix;
}

void write_placement(Hdf5Writer& file, const Placement& placement) {
  file.attribute("dimension", static_cast<std::int64_t>(placement.scale.size()));
  write_matrix(file, "placement/scale", placement.scale.transpose());
  write_matrix(file, "placement/offset", placement.offset.transpose());
}

Placement read_placement(const Hdf5Reader& file, Eigen::Index dimension) {
  return {read_matrix(file, "placement/scale", 1, dimension).transpose(),
          read_matrix(file, "placement/offset", 1, dimension).transpose()};
}

Eigen::Index read_dimension(const Hdf5Reader& file) {
  const double d = file.number_attribute("dimension");
  if (!(d >= 1 && d <= kMaxDescriptorSize))
    throw InputError("{}: attribute dimension is {}, expected 1 to {}", file.path().string(), d,
                     kMaxDescriptorSize);
  return static_cast<Eigen::Index>(d);
}

}  // namespace hbr::inline descriptor
