// The trained autoencoder as ONNX models: images [n x 1 x 28 x 28] in [0, 1] under the name "image", latent
// positions [n x d] under "position", decoded images [n x 1 x 28 x 28] under "decoded".
#pragma once

#include <string>

#include "models/autoencoder/network.h"

namespace hbr::inline onnx {

// The content of an ONNX file each.
std::string onnx_encoder(const net::Network& network);  // image -> position
std::string onnx_decoder(const net::Network& network);  // position -> decoded
std::string onnx_whole(const net::Network& network);    // image -> position, decoded

}  // namespace hbr::inline onnx
