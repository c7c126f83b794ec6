// Trains one replication's autoencoder: its latent space is the descriptor of layer 4, its reconstruction
// error the fitness (section "unsupervised descriptors" and appendix of the paper).
#include <fmt/format.h>

#include "models/autoencoder/file.h"
#include "models/autoencoder/trainer.h"
#include "pipeline/artifact/run_settings.h"
#include "pipeline/artifact/stage.h"
#include "stages/learned/descriptor_evidence.h"

namespace hbr::inline stages {
namespace {

struct StageSettings : RunTable {
  AutoencoderSettings training;
};

template <class Fields>
void describe(Fields& f, StageSettings& s) {
  describe_run(f, s);
  describe(f, s.training);
}

ImageSet set_of(const LabelledImages& half) {
  return {static_cast<std::int64_t>(half.size()), half.images.data(), half.labels.data()};
}

void write_course(Hdf5Writer& file, const TrainedAutoencoder& trained) {
  std::vector<std::int64_t> epoch, samples, tested;
  std::vector<double> train_error, test_error;
  for (const EpochReport& e : trained.epochs) {
    epoch.push_back(e.epoch);
    samples.push_back(e.samples);
    train_error.push_back(e.train_error);
    if (!e.test_error) continue;
    tested.push_back(e.epoch);
    test_error.push_back(*e.test_error);
  }
  file.write("training/epoch", epoch);
  file.write("training/samples", samples);
  file.write("training/train_error", train_error);
  file.write("training/tested", tested);
  file.write("training/test_error", test_error);
  file.write("training/kept_per_class", {10}, trained.kept_per_class.data());
}

void write_evidence(Hdf5Writer& file, const Autoencoder& autoencoder, const LabelledImages& test,
                    Workers& workers) {
  const auto dim = static_cast<std::size_t>(autoencoder.dimension());
  const std::vector<float> images = as_floats(test.images);
  std::vector<float> position(test.size() * dim);
  workers.for_ranges(test.size(), 256, [&](std::size_t begin, std::size_t end) {
    autoencoder.encode(static_cast<Eigen::Index>(end - begin), &images[begin * kImagePixels],
                       &position[begin * dim]);
  });
  write_latent(file, test, position);
  write_examples(file, test, [&](Eigen::Index n, const float* from, float* decoded) {
    std::vector<float> latent(static_cast<std::size_t>(n) * dim);
    autoencoder.encode(n, from, latent.data());
    autoencoder.decode(n, latent.data(), decoded);
  });
}

void run(StageRun& stage) {
  const auto settings = stage.settings_as<StageSettings>();
  const Dataset dataset = read_dataset(stage.input("dataset"));
  const Seed seed =
      Seed(settings.seed).child("autoencoder").child(static_cast<std::uint64_t>(settings.replication));
  Workers workers(stage.threads());

  TrainingHooks hooks;
  hooks.checkpoint = stage.checkpoint();
  hooks.on_epoch = [&](const EpochReport& e) { stage.progress(e.epoch, settings.training.epochs, "epochs"); };
  hooks.on_message = [&](const std::string& line) { fmt::print(stderr, "{}: {}\n", stage.name(), line); };
  const TrainedAutoencoder trained =
      train_autoencoder(settings.training, seed, set_of(dataset.train), set_of(dataset.test), workers, hooks);

  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  write_autoencoder(file, trained.autoencoder);
  write_course(file, trained);
  write_evidence(file, trained.autoencoder, dataset.test, workers);
  file.close();
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "Autoencoder: learns what digits look like", hbr::run);
}
