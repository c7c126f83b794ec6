// What the judge says of every image in the repertoires of HBR and of the flat baseline.
#include "models/judge/judge.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/core/check.h"

namespace {

void judge_repertoire(const hbr::Judge& judge, const std::filesystem::path& repertoire,
                      const std::string& name, hbr::Workers& workers, hbr::Hdf5Writer& file) {
  const hbr::Hdf5Reader reader(repertoire);
  const auto image = reader.read<std::uint8_t>("image");
  const auto measures = reader.read<float>("measures");
  const auto id = reader.read<std::int64_t>("id");
  const auto objective = reader.read<float>("objective");
  const std::size_t n = objective.values.size();
  if (image.shape != std::vector<std::size_t>{n, hbr::kImageSide, hbr::kImageSide} ||
      measures.shape.size() != 2 || measures.shape[0] != n || id.values.size() != n)
    throw hbr::InputError(
        "{}: id, image, measures and objective disagree about the number of elites, {}; make it again",
        repertoire.string(), n);
  const hbr::Verdicts verdicts = judge.judge(n, image.values.data(), workers);
  file.write(name + "/id", id);
  file.write(name + "/image", image);
  file.write(name + "/measures", measures);
  file.write(name + "/objective", objective);
  file.write(name + "/label", verdicts.label);
  file.write(name + "/confidence", {n}, verdicts.confidence.data());
  file.write(name + "/distance", {n}, verdicts.distance.data());
  file.write(name + "/good", verdicts.good);
}

void run(hbr::StageRun& stage) {
  hbr::Workers workers(stage.threads());
  const hbr::Dataset dataset = hbr::read_dataset(stage.input("dataset"));
  const hbr::Judge judge(hbr::Hdf5Reader(stage.input("judge")), dataset, workers);
  hbr::Hdf5Writer file(stage.output());
  for (const char* name : {"hbr", "flat"}) judge_repertoire(judge, stage.input(name), name, workers, file);
  file.close();
}

}  // namespace

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "Verdicts of the judge on digits", run);
}
