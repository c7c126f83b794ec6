// The dataset: four IDX files, checked, as one artifact.
#include "models/dataset/dataset.h"

#include "pipeline/artifact/stage.h"
#include "stages/learned/data_settings.h"

namespace {

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<hbr::DatasetSettings>();
  const hbr::Dataset dataset = hbr::read_idx_folder(s.name, s.folder, s.sha256);
  hbr::Hdf5Writer file(stage.output());
  hbr::write_dataset(file, dataset);
  file.close();
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Dataset: images and labels", run); }
