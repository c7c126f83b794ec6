// A replication's autoencoder for other programs: encoder.onnx, decoder.onnx and whole.onnx.
#include <filesystem>
#include <fstream>

#include "models/autoencoder/file.h"
#include "models/onnx/export.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/core/check.h"

namespace {

void run(hbr::StageRun& stage) {
  const hbr::Autoencoder autoencoder = hbr::load_autoencoder(stage.input("autoencoder"));
  std::filesystem::create_directories(stage.output());
  const hbr::net::Network& network = autoencoder.network();
  using Model = std::pair<const char*, std::string>;
  for (const auto& [name, content] :
       {Model{"encoder.onnx", hbr::onnx_encoder(network)}, Model{"decoder.onnx", hbr::onnx_decoder(network)},
        Model{"whole.onnx", hbr::onnx_whole(network)}}) {
    const std::filesystem::path path = stage.output() / name;
    std::ofstream file(path, std::ios::binary);
    file << content;
    if (!file.flush()) throw hbr::InputError("{}: can't write this file; is the disk full?", path.string());
  }
}

}  // namespace

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "ONNX: the autoencoder for other programs", run);
}
