#include "models/onnx/onnx_descriptor.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <vector>

#include "models/onnx/file/shown.h"
#include "models/onnx/file/weights.h"
#include "models/onnx/input_shape.h"
#include "models/onnx/opencv_network.h"
#include "models/onnx/tensors.h"
#include "pipeline/artifact/json_file.h"
#include "pipeline/core/check.h"
#include "pipeline/drawing/draw.h"

namespace hbr::inline onnx {
namespace {

// Numbers at black and at white, between which pixels 0 to 1 lie.
struct PixelRange {
  explicit PixelRange(const std::vector<double>& range)
      : black(static_cast<float>(range[0])), white(static_cast<float>(range[1])) {}
  float from_pixel(float pixel) const { return black + (white - black) * pixel; }
  float to_pixel(float number) const { return (number - black) / (white - black); }
  float black, white;
};

// An image that shows a network's numbers better than a black one.
std::vector<float> first_image(const PixelRange& range) {
  std::vector<float> image(kImagePixels);
  for (int i = 0; i < kImagePixels; ++i)
    image[static_cast<std::size_t>(i)] = range.from_pixel(static_cast<float>(i * 37 % 256) / 255.f);
  return image;
}

template <class Work>
auto with_name(const std::string& where, Work&& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError("{}: {}", where, error.what());
  }
}

OnnxSettings settings_of(const Hdf5Reader& file) {
  if (!file.has_attribute("onnx")) return {};
  const std::string where = file.path().string();
  return settings_from_json<OnnxSettings>(parse_json(file.text_attribute("onnx"), where + ": onnx"), where);
}

}  // namespace

// What to run and networks to run: one for each thread, since each serves one at a time.
struct OnnxDescriptor::Network {
  Network(std::string_view content, const std::string& where_, const OnnxSettings& told)
      : where(where_), settings(told) {
    const auto named = [&](auto&& work) { return with_name(where, work); };
    if (const std::string fault = fault_of(settings); !fault.empty())
      throw InputError("{}: {}", where, fault);
    model = named([&] { return plain_weights(content, where); });
    const OnnxModel parsed = named([&] { return parse_onnx(model); });
    const auto shapes = named([&] { return input_shapes(parsed, settings.input_shape); });
    const std::vector<std::string> tensors = named([&] { return tensors_to_try(parsed, settings); });
    const std::vector<float> image = first_image(PixelRange(settings.input_range));
    std::string complaint;
    std::optional<std::uint64_t> numbers;  // a hash of what comes out
    for (const std::vector<int>& shape : shapes) {
      Trial trial;
      try {
        trial = try_network(parsed, tensors, shape, image, where);
      } catch (const InputError& error) {
        if (complaint.empty()) complaint = error.what();
        continue;
      }
      const ChosenTensors chosen = named([&] { return choose_tensors(parsed, trial.shapes, told); });
      const Trial last = try_network(parsed, {chosen.position, chosen.reconstruction}, shape, image, where);
      if (!last.shapes.contains(chosen.position))
        throw InputError(
            "{}: OpenCV {} gives the tensor '{}' of the whole network, but not of what leads to it alone; "
            "name another as position",
            where, CV_VERSION, shown(chosen.position));
      if (!numbers) {
        numbers = last.hash;
        dimension = static_cast<Eigen::Index>(last.shapes.at(chosen.position).numbers());
        settings.position = chosen.position;
        settings.reconstruction = chosen.reconstruction;
        settings.input_shape = shape;
      } else if (*numbers != last.hash) {
        throw InputError(
            "{}: its input takes images of the shapes {} and {}, with different results; set "
            "input_shape to the one that is meant",
            where, TensorShape{settings.input_shape}.text(), TensorShape{shape}.text());
      }
    }
    if (!numbers) throw InputError("{}", complaint);
    part = part_of(parsed, {settings.position, settings.reconstruction},
                   {settings.input_shape.begin(), settings.input_shape.end()});
  }

  std::unique_ptr<OpenCvNetwork> borrow() {
    const std::lock_guard lock(mutex);
    if (idle.empty()) return std::make_unique<OpenCvNetwork>(part, settings.input_shape);
    auto net = std::move(idle.back());
    idle.pop_back();
    return net;
  }
  void give_back(std::unique_ptr<OpenCvNetwork> net) {
    const std::lock_guard lock(mutex);
    idle.push_back(std::move(net));
  }

  std::string where;
  OnnxSettings settings;    // with all that was found out
  std::string model, part;  // ONNX files: all of it, and what is run
  Eigen::Index dimension = 0;
  std::mutex mutex;
  std::vector<std::unique_ptr<OpenCvNetwork>> idle;
};

OnnxDescriptor::OnnxDescriptor(std::unique_ptr<Network> network)
    : ReconstructingDescriptor(network->dimension),
      network_(std::move(network)),
      placement_{Eigen::VectorXf::Ones(dimension()), Eigen::VectorXf::Zero(dimension())} {}

OnnxDescriptor::OnnxDescriptor(std::string_view model, const std::string& where, const OnnxSettings& settings)
    : OnnxDescriptor(std::make_unique<Network>(model, where, settings)) {}

OnnxDescriptor::OnnxDescriptor(const Hdf5Reader& file)
    : OnnxDescriptor(std::make_unique<Network>(
          [&] {
            const auto bytes = file.read<std::uint8_t>("onnx/model").values;
            return std::string(bytes.begin(), bytes.end());
          }(),
          file.path().string(), settings_of(file))) {
  placement_ = read_placement(file, dimension());
}

OnnxDescriptor::~OnnxDescriptor() = default;

const OnnxSettings& OnnxDescriptor::settings() const { return network_->settings; }

void OnnxDescriptor::place(const Rows& raw) {
  constexpr float kRounding = 1e-6f;  // of float32, relative
  for (Eigen::Index d = 0; d < raw.cols(); ++d) {
    const float low = raw.col(d).minCoeff(), high = raw.col(d).maxCoeff();
    if (high - low <= kRounding * std::max(std::abs(low), std::abs(high)))
      throw InputError(
          "{}: coordinate {} (of {}) of the position '{}' is {} for all {} training images: they "
          "differ by {}, no more than float32 rounds; expected positions that tell images apart",
          network_->where, d + 1, raw.cols(), shown(settings().position), low, raw.rows(), high - low);
  }
  if (raw.cwiseAbs().maxCoeff() > 1) placement_ = fill_unit_box(raw);
}

void OnnxDescriptor::reconstruct(Eigen::Index n, const float* images, float* position, float* decoded) const {
  const Eigen::Index dim = dimension();
  const PixelRange in(settings().input_range), out(settings().reconstruction_range);
  auto net = network_->borrow();
  std::vector<float> input(kImagePixels);
  for (Eigen::Index i = 0; i < n; ++i) {
    std::transform(images + i * kImagePixels, images + (i + 1) * kImagePixels, input.begin(),
                   [&](float pixel) { return in.from_pixel(pixel); });
    const std::vector<cv::Mat> values = with_name(network_->where, [&] {
      return net->run(input.data(), {settings().position, settings().reconstruction});
    });
    const Eigen::Map<const Eigen::VectorXf> place(values[0].ptr<float>(), dim),
        image(values[1].ptr<float>(), kImagePixels);
    if (!place.allFinite() || !image.allFinite())
      throw InputError("{}: what the network makes of an image is not a finite number", network_->where);
    for (Eigen::Index d = 0; d < dim; ++d)
      position[i * dim + d] = place[d] * placement_.scale[d] + placement_.offset[d];
    std::transform(image.begin(), image.end(), decoded + i * kImagePixels,
                   [&](float number) { return out.to_pixel(number); });
  }
  network_->give_back(std::move(net));
}

void OnnxDescriptor::write(Hdf5Writer& file) const {
  file.attribute("kind", std::string("onnx"));
  file.attribute("onnx", settings_to_json(settings()).dump());
  file.write("onnx/model", {network_->model.size()},
             reinterpret_cast<const std::uint8_t*>(network_->model.data()));
  write_placement(file, placement_);
}

}  // namespace hbr::inline onnx
