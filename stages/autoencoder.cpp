// Trains one replication's autoencoder: its latent space is the descriptor of layer 4, its reconstruction
// error the fitness (section "unsupervised descriptors" and appendix of the paper).
#include "models/autoencoder/file.h"
#include "models/autoencoder/trainer.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace {

struct StageSettings {
  std::uint64_t seed = 0;
  int replication = 0;
  AutoencoderSettings training;
};

template <class Fields>
void describe(Fields& f, StageSettings& s) {
  f.number("seed", s.seed, Range{0, 9e15}, "master seed");
  f.number("replication", s.replication, Range{0, 1e6}, "index of the replication");
  describe(f, s.training);
}

// Images and labels of one half of dataset.h5.
struct Images {
  Images(const Hdf5Reader& file, const std::string& half)
      : pixels(file.read<std::uint8_t>(half + "/images")), labels(file.read<std::uint8_t>(half + "/labels")) {
    if (pixels.shape.size() != 3 || pixels.shape[1] != 28 || pixels.shape[2] != 28 ||
        labels.shape != std::vector<std::size_t>{pixels.shape[0]})
      throw InputError("{}: {}: expected images n x 28 x 28 and n labels", file.path().string(), half);
  }
  ImageSet set() const {
    return {static_cast<std::int64_t>(pixels.shape[0]), pixels.values.data(), labels.values.data()};
  }

  Array<std::uint8_t> pixels, labels;
};

std::vector<float> as_floats(const std::uint8_t* bytes, std::int64_t n) {
  std::vector<float> floats(static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < floats.size(); ++i) floats[i] = static_cast<float>(bytes[i]) / 255.f;
  return floats;
}

void write_course(Hdf5Writer& file, const TrainedAutoencoder& trained) {
  std::vector<std::int64_t> epoch, samples;
  std::vector<double> train_error, test_error;
  for (const EpochReport& e : trained.epochs) {
    epoch.push_back(e.epoch);
    samples.push_back(e.samples);
    train_error.push_back(e.train_error);
    test_error.push_back(e.test_error);
  }
  file.write("training/epoch", epoch);
  file.write("training/samples", samples);
  file.write("training/train_error", train_error);
  file.write("training/test_error", test_error);
  file.write("training/kept_per_class", {10}, trained.kept_per_class.data());
}

// Where the test images lie in the latent space.
void write_latent(Hdf5Writer& file, const Autoencoder& autoencoder, const ImageSet& test, Workers& workers) {
  const auto n = static_cast<std::size_t>(test.count),
             dim = static_cast<std::size_t>(autoencoder.dimension());
  const std::vector<float> images = as_floats(test.images, test.count * 784);
  std::vector<float> position(n * dim);
  workers.for_ranges(n, 256, [&](std::size_t begin, std::size_t end) {
    autoencoder.encode(static_cast<Eigen::Index>(end - begin), images.data() + begin * 784,
                       position.data() + begin * dim);
  });
  file.write("latent/position", {n, dim}, position.data());
  file.write("latent/label", {n}, test.labels);
}

// The first two test images of each class, and what the network makes of them.
void write_examples(Hdf5Writer& file, const Autoencoder& autoencoder, const ImageSet& test) {
  std::vector<std::uint8_t> original;
  for (int label = 0; label < 10; ++label)
    for (std::int64_t i = 0, found = 0; i < test.count && found < 2; ++i)
      if (test.labels[i] == label) {
        original.insert(original.end(), test.images + i * 784, test.images + (i + 1) * 784);
        ++found;
      }
  const std::size_t n = original.size() / 784;
  const std::vector<float> images = as_floats(original.data(), static_cast<std::int64_t>(original.size()));
  std::vector<float> latent(n * static_cast<std::size_t>(autoencoder.dimension())), decoded(n * 784);
  autoencoder.encode(static_cast<Eigen::Index>(n), images.data(), latent.data());
  autoencoder.decode(static_cast<Eigen::Index>(n), latent.data(), decoded.data());
  file.write("reconstruction/original", {n, 28, 28}, original.data());
  file.write("reconstruction/decoded", {n, 28, 28}, decoded.data());
}

void run(StageRun& stage) {
  const auto settings = stage.settings_as<StageSettings>();
  const Hdf5Reader dataset(stage.input("dataset"));
  const Images train(dataset, "train"), test(dataset, "test");
  const Seed seed =
      Seed(settings.seed).child("autoencoder").child(static_cast<std::uint64_t>(settings.replication));
  Workers workers(stage.threads());

  TrainingHooks hooks;
  hooks.checkpoint = stage.checkpoint();
  hooks.on_epoch = [&](const EpochReport& e) { stage.progress(e.epoch, settings.training.epochs, "epochs"); };
  hooks.on_message = [&](const std::string& line) { fmt::print(stderr, "{}: {}\n", stage.name(), line); };
  const TrainedAutoencoder trained =
      train_autoencoder(settings.training, seed, train.set(), test.set(), workers, hooks);

  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  write_autoencoder(file, trained.autoencoder);
  write_course(file, trained);
  write_latent(file, trained.autoencoder, test.set(), workers);
  write_examples(file, trained.autoencoder, test.set());
  file.close();
}

}  // namespace
}  // namespace hbr

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "Autoencoder: learns what digits look like", hbr::run);
}
