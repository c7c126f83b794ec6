// Which of a network's tensors are the position and the reconstruction.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "models/onnx/file/model.h"
#include "models/onnx/onnx_settings.h"
#include "models/onnx/opencv_network.h"

namespace hbr::inline onnx {

struct ChosenTensors {
  std::string position, reconstruction;
};

// The tensors whose shapes choose_tensors needs. Throws InputError where the settings name one that is not
// made of the image.
std::vector<std::string> tensors_to_try(const OnnxModel& model, const OnnxSettings& settings);

// Those that the settings name. Else the reconstruction is the output of 784 numbers, and the position the
// output of at most 8 real ones; where there is no such output, it is the narrowest tensor through which all
// passes that the reconstruction knows of the image (of equals the last, which is what the decoder reads).
// Throws InputError, which lists the candidates, where there are several: two such outputs, an output that
// the reconstruction is not made of beside a narrow tensor that it is made of, a tensor as narrow that does
// not hold all (as of attention), or narrow tensors of the same size with weights in between.
ChosenTensors choose_tensors(const OnnxModel& model, const std::map<std::string, TensorShape>& shapes,
                             const OnnxSettings& settings);

}  // namespace hbr::inline onnx
