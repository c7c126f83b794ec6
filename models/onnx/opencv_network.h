// ONNX networks run by OpenCV. Its errors have many lines, and some networks end the process that reads them:
// all that leaves this file is one line.
#pragma once

#include <opencv2/dnn.hpp>
#include <string>
#include <vector>

#include "models/onnx/file/model.h"
#include "models/onnx/trial.h"

namespace hbr::inline onnx {

class OpenCvNetwork {
 public:
  // onnx: the content of an ONNX file of one input, shape: that input's. Throws InputError with OpenCV's
  // reason.
  OpenCvNetwork(const std::string& onnx, std::vector<int> shape);
  // Whether it gives this output: nodes that OpenCV fuses leave none.
  bool gives(const std::string& tensor) const;
  // Outputs of an input, as many numbers as its shape says. They are this network's until its next run.
  // Throws InputError likewise.
  std::vector<cv::Mat> run(const float* image, const std::vector<std::string>& tensors);

 private:
  cv::dnn::Net net_;
  std::vector<int> shape_;
};

// Runs so much of the network as makes `tensors` of `image`, in a process of its own. Throws InputError, with
// `where` before the words; where OpenCV can't run a node, they name node and operator.
Trial try_network(const OnnxModel& model, const std::vector<std::string>& tensors,
                  const std::vector<int>& input_shape, const std::vector<float>& image,
                  const std::string& where);

}  // namespace hbr::inline onnx
