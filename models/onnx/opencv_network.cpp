#include "models/onnx/opencv_network.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <opencv2/core/utils/logger.hpp>
#include <string_view>

#include "models/onnx/file/shown.h"
#include "pipeline/core/check.h"
#include "pipeline/process/own_process.h"

namespace hbr::inline onnx {
namespace {

// The innermost reason of OpenCV's words, each the reason of those before: "OpenCV(4.6.0) FILE:LINE: error:
// (-215:Assertion failed) REASON in function 'F'".
std::string reason(const cv::Exception& error) {
  std::string text = error.err;
  if (const std::size_t last = text.rfind("error: ("); last != std::string::npos)
    text = text.substr(last + 7);
  text = text.substr(0, text.find(" in function '"));
  return shown(text.substr(0, text.find_last_not_of(" \n") + 1));
}

Trial run_once(const OnnxModel& model, const std::vector<std::string>& tensors,
               const std::vector<int>& input_shape, const std::vector<float>& image) {
  OpenCvNetwork network(part_of(model, tensors, {input_shape.begin(), input_shape.end()}), input_shape);
  std::vector<std::string> given;
  std::ranges::copy_if(tensors, std::back_inserter(given),
                       [&](const std::string& tensor) { return network.gives(tensor); });
  Trial trial;
  if (given.empty()) return trial;
  const std::vector<cv::Mat> values = network.run(image.data(), given);
  for (std::size_t i = 0; i < given.size(); ++i) {
    const cv::Mat& m = values[i];
    const bool floats = m.type() == CV_32F && m.isContinuous();
    trial.shapes[given[i]] = {{m.size.p, m.size.p + m.dims}, floats};
    const std::string_view bytes(reinterpret_cast<const char*>(m.data),
                                 floats ? m.total() * m.elemSize() : 0);
    trial.hash = 31 * trial.hash + std::hash<std::string_view>{}(bytes);
  }
  return trial;
}

std::string advice(const OnnxNode& node) {
  if (node.operation.starts_with("Random") || node.operation == "Bernoulli" ||
      node.operation == "Multinomial")
    return "export the network as it is evaluated, without sampling (PyTorch: model.eval())";
  if (!node.domain.empty() && node.domain != "ai.onnx")
    return fmt::format("it is not ONNX's own but of '{}': export the network without such operators",
                       shown(node.domain));
  return "export the network with other operators for it (an older operator set such as 13, constants "
         "folded), or simplify the file (onnxsim)";
}

}  // namespace

OpenCvNetwork::OpenCvNetwork(const std::string& onnx, std::vector<int> shape) : shape_(std::move(shape)) {
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);  // the exception says it all
  cv::setNumThreads(1);
  try {
    net_ = cv::dnn::readNetFromONNX(onnx.data(), onnx.size());
    net_.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    net_.setPreferableTarget(cv::dnn::DNN_TARGET_CPU);
  } catch (const cv::Exception& error) {
    throw InputError("{}", reason(error));
  }
}

bool OpenCvNetwork::gives(const std::string& tensor) const { return net_.getLayerId(tensor) >= 0; }

std::vector<cv::Mat> OpenCvNetwork::run(const float* image, const std::vector<std::string>& tensors) {
  std::vector<cv::Mat> values;
  try {
    net_.setInput(cv::Mat(shape_, CV_32F, const_cast<float*>(image)));
    net_.forward(values, tensors);
  } catch (const cv::Exception& error) {
    throw InputError("{}", reason(error));
  }
  return values;
}

Trial try_network(const OnnxModel& model, const std::vector<std::string>& tensors,
                  const std::vector<int>& input_shape, const std::vector<float>& image,
                  const std::string& where) {
  std::size_t bytes = 0;
  for (const auto& [name, tensor] : model.weights) bytes += tensor.size();
  const OwnProcess apart{(std::size_t{1} << 30) + 16 * bytes, 60};
  const auto attempt = [&](const std::vector<std::string>& some) {
    return understood(
        where, apart.run(where, [&] { return told(run_once(model, some, input_shape, image), some); }), some);
  };
  std::string complaint;
  try {
    return attempt(tensors);
  } catch (const InputError& error) {
    complaint = error.what();
  }
  // Which node is it? The network is tried up to its first node, up to its second, ..., by bisection.
  const std::vector<const OnnxNode*> nodes = needed_nodes(model, tensors);
  std::size_t works = 0, fails = nodes.size() + 1;
  while (fails - works > 1) {
    const std::size_t most = (works + fails) / 2;
    std::vector<std::string> made;
    for (std::size_t i = 0; i < most; ++i) made.push_back(nodes[i]->first_output());
    try {
      attempt(made);
      works = most;
    } catch (const InputError& error) {
      complaint = error.what();
      fails = most;
    }
  }
  const std::string why = complaint.substr(where.size() + 2);
  if (fails > nodes.size()) throw InputError("{}: OpenCV {} can't run it: {}", where, CV_VERSION, why);
  const OnnxNode& node = *nodes[fails - 1];
  throw InputError("{}: OpenCV {} can't run the operator {} (node '{}', which makes '{}'): {}; {}", where,
                   CV_VERSION, shown(node.operation), shown(node.name), shown(node.first_output()), why,
                   advice(node));
}

}  // namespace hbr::inline onnx
