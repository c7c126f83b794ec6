// A replication's autoencoder for other programs: encoder.onnx, decoder.onnx and whole.onnx.
#include <filesystem>

#include "models/autoencoder/file.h"
#include "models/onnx/export.h"
#include "pipeline/artifact/content.h"
#include "pipeline/artifact/stage.h"

namespace {

void run(hbr::StageRun& stage) {
  const hbr::Autoencoder autoencoder = hbr::load_autoencoder(stage.input("autoencoder"));
  std::filesystem::create_directories(stage.output());
  const hbr::net::Network& network = autoencoder.network();
  using Model = std::pair<const char*, std::string>;
  for (const auto& [name, content] :
       {Model{"encoder.onnx", hbr::onnx_encoder(network)}, Model{"decoder.onnx", hbr::onnx_decoder(network)},
        Model{"whole.onnx", hbr::onnx_whole(network)}})
    hbr::write_file(stage.output() / name, content);
}

}  // namespace

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "ONNX: the autoencoder for other programs", run);
}
