#include "models/onnx/onnx_descriptor.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/dnn.hpp>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/drawing/draw.h"
#include "pipeline/process/own_process.h"
#include "pipeline/qd/dimension.h"

namespace hbr {
namespace {

cv::dnn::Net read_net(const std::string& model, const std::string& where) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // the exception says it all
  cv::setNumThreads(1);
  try {
    cv::dnn::Net net = cv::dnn::readNetFromONNX(model.data(), model.size());
    net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    net.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
    return net;
  } catch (const cv::Exception& error) {
    throw InputError("{}: not an ONNX network that OpenCV {} reads: {}", where, CV_VERSION,
                     error.err.substr(0, error.err.find('\n')));
  }
}

std::vector<cv::Mat> run(cv::dnn::Net& net, const std::vector<int>& shape, const float* image,
                         const std::vector<std::string>& layers) {
  net.setInput(cv::Mat(shape, CV_32F, const_cast<float*>(image)));
  std::vector<cv::Mat> values;
  net.forward(values, layers);
  return values;
}

// How many numbers a layer makes of an image, whether nothing follows it, and whether they are floats.
struct Width {
  std::string layer;
  std::size_t numbers;
  bool output, floats;
};

// Of all layers but constants, in the order of execution, given a black image of the first shape that fits.
std::vector<Width> widths(const std::string& model, const std::string& where, std::vector<int>& shape) {
  const std::vector<float> black(kImagePixels, 0.f);
  std::string complaint;
  for (const std::vector<int>& candidate :
       {std::vector<int>{1, kImagePixels}, std::vector<int>{1, 1, 28, 28}, std::vector<int>{1, 28, 28, 1}}) {
    cv::dnn::Net net = read_net(model, where);
    std::vector<std::string> layers = net.getLayerNames();
    std::erase_if(
        layers, [&](const std::string& name) { return net.getLayer(net.getLayerId(name))->type == "Const"; });
    const std::vector<std::string> ends = net.getUnconnectedOutLayersNames();
    try {
      const std::vector<cv::Mat> values = run(net, candidate, black.data(), layers);
      std::vector<Width> result;
      for (std::size_t i = 0; i < layers.size(); ++i)
        result.push_back({layers[i], values[i].total(), std::ranges::count(ends, layers[i]) > 0,
                          values[i].type() == CV_32F && values[i].isContinuous()});
      shape = candidate;
      return result;
    } catch (const cv::Exception& error) {
      complaint = error.err.substr(0, error.err.find('\n'));
    }
  }
  throw InputError("{}: expected a network that takes images n x 784 or n x 1 x 28 x 28; OpenCV says: {}",
                   where, complaint);
}

// OpenCV crashes on some files, damaged ones and good ones (whose weights are elsewhere): a first look at the
// network is not to be trusted with this process.
void try_apart(const std::string& model, const std::string& where) {
  const OwnProcess apart{(std::size_t{1} << 30) + 16 * model.size(), 60};
  apart.run(where, [&] {
    std::vector<int> shape;
    try {
      widths(model, where, shape);
    } catch (const InputError& error) {
      throw InputError("{}", std::string(error.what()).substr(where.size() + 2));  // which run() adds again
    }
    return std::string();
  });
}

}  // namespace

// Which layers to ask, and networks to ask: one for each thread, since a cv::dnn::Net serves one at a time.
struct OnnxDescriptor::Network {
  Network(std::string model_, const std::string& where_) : model(std::move(model_)), where(where_) {
    try_apart(model, where);
    const std::vector<Width> all = widths(model, where, shape);
    std::vector<Width> images, places;
    std::vector<std::size_t> sizes;
    for (const Width& w : all) {
      if (!w.output) continue;
      sizes.push_back(w.numbers);
      if (w.numbers == kImagePixels) images.push_back(w);
      if (w.numbers <= kMaxDescriptorSize) places.push_back(w);
    }
    if (images.size() != 1)
      throw InputError("{}: expected one output of 784 numbers an image, found outputs of {}", where,
                       fmt::join(sizes, ", "));
    const Width narrowest = *std::ranges::min_element(all.rbegin(), all.rend(), {}, &Width::numbers);
    if (narrowest.numbers > kMaxDescriptorSize)
      throw InputError("{}: its narrowest layer, {}, has {} numbers an image; expected 1 to {} as position",
                       where, narrowest.layer, narrowest.numbers, kMaxDescriptorSize);
    const Width& place = places.size() == 1 ? places[0] : narrowest;
    if (!place.floats || !images[0].floats)
      throw InputError("{}: expected a network that gives numbers of type float32", where);
    position = place.layer;
    decoded = images[0].layer;
    dimension = static_cast<Eigen::Index>(place.numbers);
  }

  std::unique_ptr<cv::dnn::Net> borrow() {
    const std::lock_guard lock(mutex);
    if (idle.empty()) return std::make_unique<cv::dnn::Net>(read_net(model, where));
    auto net = std::move(idle.back());
    idle.pop_back();
    return net;
  }
  void give_back(std::unique_ptr<cv::dnn::Net> net) {
    const std::lock_guard lock(mutex);
    idle.push_back(std::move(net));
  }

  std::string model, where;
  std::vector<int> shape;  // of an image
  std::string position, decoded;
  Eigen::Index dimension = 0;
  std::mutex mutex;
  std::vector<std::unique_ptr<cv::dnn::Net>> idle;
};

OnnxDescriptor::OnnxDescriptor(std::unique_ptr<Network> network)
    : ReconstructingDescriptor(network->dimension),
      network_(std::move(network)),
      placement_{Eigen::VectorXf::Ones(dimension()), Eigen::VectorXf::Zero(dimension())} {}

OnnxDescriptor::OnnxDescriptor(std::string model, const std::string& where)
    : OnnxDescriptor(std::make_unique<Network>(std::move(model), where)) {}

OnnxDescriptor::OnnxDescriptor(const Hdf5Reader& file)
    : OnnxDescriptor(
          [&] {
            const auto bytes = file.read<std::uint8_t>("onnx/model").values;
            return std::string(bytes.begin(), bytes.end());
          }(),
          file.path().string()) {
  placement_ = read_placement(file, dimension());
}

OnnxDescriptor::~OnnxDescriptor() = default;

void OnnxDescriptor::place(const Rows& raw) {
  if (raw.cwiseAbs().maxCoeff() > 1) placement_ = fill_unit_box(raw);
}

void OnnxDescriptor::reconstruct(Eigen::Index n, const float* images, float* position, float* decoded) const {
  const Eigen::Index dim = dimension();
  auto net = network_->borrow();
  for (Eigen::Index i = 0; i < n; ++i) {
    const std::vector<cv::Mat> values =
        run(*net, network_->shape, images + i * kImagePixels, {network_->position, network_->decoded});
    const Eigen::Map<const Eigen::VectorXf> place(values[0].ptr<float>(), dim),
        image(values[1].ptr<float>(), kImagePixels);
    if (!place.allFinite() || !image.allFinite())
      throw InputError("{}: what the network makes of an image is not a finite number", network_->where);
    for (Eigen::Index d = 0; d < dim; ++d)
      position[i * dim + d] = place[d] * placement_.scale[d] + placement_.offset[d];
    std::copy_n(image.data(), kImagePixels, decoded + i * kImagePixels);
  }
  network_->give_back(std::move(net));
}

void OnnxDescriptor::write(Hdf5Writer& file) const {
  file.attribute("kind", std::string("onnx"));
  file.write("onnx/model", {network_->model.size()},
             reinterpret_cast<const std::uint8_t*>(network_->model.data()));
  write_placement(file, placement_);
}

}  // namespace hbr
