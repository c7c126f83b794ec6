// NAO's meshes, as files that nao.urdf names.
#include "models/nao/nao_meshes.h"
#include "pipeline/artifact/stage.h"

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "NAO's meshes",
                         [](hbr::StageRun& stage) { hbr::write_nao_meshes(stage.output()); });
}
