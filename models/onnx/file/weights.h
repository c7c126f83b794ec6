// The weights of an ONNX file, wherever and as whatever they are kept.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace hbr::inline onnx {

// The content of the ONNX file `file` with all weights in it and real ones as float32: what stands in files
// beside it ("external data") is put in, float16, bfloat16 and double are converted. Unchanged where there is
// nothing to do. Throws InputError where the content is no ONNX network, a file of weights is missing, too
// short or outside the network's folder, and where weights are more or fewer than their shape says.
std::string plain_weights(std::string_view model, const std::filesystem::path& file);

// The files beside `file` that hold weights of it, in order; none where it can't be read.
std::vector<std::filesystem::path> weight_files(const std::filesystem::path& file);

}  // namespace hbr::inline onnx
