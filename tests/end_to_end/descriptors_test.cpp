// Digits by other latent sizes and descriptors, by profile alone.
#include <gmock/gmock.h>

#include "pipeline/artifact/hdf5_file.h"
#include "tests/end_to_end/tiny_experiment.h"
#include "tests/models/onnx/other_networks.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::Not;

class Descriptors : public testing::Test {
 protected:
  Descriptors() {
    experiment_.profile.set("autoencoder", "latent_size", "3");
    experiment_.profile.set("descriptor.kernel_pca", "landmarks", "50");
  }
  void write(const std::string& name, const std::string& head, const std::string& tables) const {
    experiment_.profile.write(experiment_.out("base.toml"));
    std::ofstream(experiment_.out(name)) << "base = \"base.toml\"\nname = \"mine\"\n" << head << tables;
  }
  std::vector<std::size_t> shape(const std::string& file, const std::string& array) const {
    return Hdf5Reader(experiment_.out(file)).read<float>(array).shape;
  }
  TinyExperiment experiment_;
};

TEST_F(Descriptors, AreChosenByTheProfileAlone) {
  std::string variations;
  for (const std::string kind : {"pca", "kernel_pca"})
    variations += "[[variations]]\nname = \"" + kind + "\"\nchanges = \"Other.\"\nset.descriptor.kind = \"" +
                  kind + "\"\n";
  write("mine.toml", "robots = []\n", variations);
  const ShellResult outcome = experiment_.make_of("mine.toml", "out", 2);
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  for (const std::string of : {"out/", "out/pca/", "out/kernel_pca/"}) {
    EXPECT_EQ(shape(of + "layer4/00.h5", "measures")[1], 3u) << of;
    EXPECT_EQ(shape(of + "digit_verdicts/00.h5", "flat/measures")[1], 3u) << of;
  }
  EXPECT_THAT(made(outcome), Not(HasSubstr("pca/autoencoder")));
  EXPECT_THAT(made(outcome), Not(HasSubstr("pca/layer3")));
  const std::string page = read(experiment_.out("out/page/index.html"));
  EXPECT_THAT(page, HasSubstr("first two latent dimensions"));
  EXPECT_THAT(page, HasSubstr("<code>kernel_pca</code>"));

  // The autoencoder comes back as a network from elsewhere, and gives the same places to the test images.
  const fs::path file = experiment_.out("network.onnx");
  fs::copy_file(experiment_.out("out/onnx/00/whole.onnx"), file);
  write("mine.toml", "robots = []\n", "[descriptor]\nkind = \"onnx\"\nfile = \"" + file.string() + "\"\n");
  const ShellResult imported = experiment_.make_of("mine.toml", "imported", 1);
  ASSERT_EQ(imported.code, 0) << imported.text;
  EXPECT_THAT(made(imported), Not(HasSubstr("autoencoder")));
  const auto expected = Hdf5Reader(experiment_.out("out/autoencoder/00.h5")).read<float>("latent/position"),
             found = Hdf5Reader(experiment_.out("imported/descriptor.h5")).read<float>("latent/position");
  ASSERT_EQ(found.shape, expected.shape);
  for (std::size_t i = 0; i < expected.values.size(); ++i)
    ASSERT_NEAR(found.values[i], expected.values[i], 1e-5);
  EXPECT_THAT(read(experiment_.out("imported/page/index.html")), HasSubstr("in place of the paper"));

  // One thread or two, the same bytes; it is run again where the file changes, not where it is touched.
  ASSERT_EQ(experiment_.make_of("mine.toml", "twice", 2).code, 0);
  EXPECT_TRUE(experiment_.artifacts("imported") == experiment_.artifacts("twice"));
  fs::last_write_time(file, fs::file_time_type::clock::now());
  EXPECT_EQ(made(experiment_.make_of("mine.toml", "imported", 1)), "");
  fs::copy_file(experiment_.out("out/onnx/00/decoder.onnx"), file, fs::copy_options::overwrite_existing);
  const ShellResult wrong = experiment_.make_of("mine.toml", "imported", 1);
  EXPECT_NE(wrong.code, 0);
  EXPECT_THAT(wrong.text, HasSubstr("network.onnx: expected a network that takes images n x 784"));
  fs::remove(file);
  EXPECT_THAT(experiment_.make_of("mine.toml", "imported", 1).text, HasSubstr("network.onnx"));
}

// As exported with its weights in a file beside it: made again where they change, refused where they are
// gone.
TEST_F(Descriptors, OfNetworksWithWeightsBesideThem) {
  OtherAutoencoder network(2);
  std::string beside;
  network.written_by([&](const std::string& name, const std::vector<int>& dims, const Rows& m) {
    const std::string data = other::in_file("weights.bin", std::to_string(beside.size()), "");
    beside += other::raw(numbers_of(m));
    return other::tensor(name, other::kFloat, dims, data);
  });
  const std::string content = network.content({-1, 784});
  std::ofstream(experiment_.out("network.onnx"), std::ios::binary) << content;
  std::ofstream(experiment_.out("weights.bin"), std::ios::binary) << beside;
  const std::string table = "[descriptor]\nkind = \"onnx\"\nfile = \"" +
                            experiment_.out("network.onnx").string() +
                            "\"\n[descriptor.onnx]\ninput_range = [0, 255]\n";
  write("mine.toml", "robots = []\n", table);
  const auto make = [&] { return experiment_.make_of("mine.toml", "out", 1, "descriptor"); };
  const ShellResult outcome = make();
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("position 'z', reconstruction 'recon', images of 1 x 784"));
  EXPECT_THAT(outcome.text, HasSubstr("odd: test images are reconstructed worse"));
  EXPECT_EQ(shape("out/descriptor.h5", "latent/position")[1], 2u);
  EXPECT_EQ(made(make()), "");
  beside[0] ^= 1;
  std::ofstream(experiment_.out("weights.bin"), std::ios::binary) << beside;
  EXPECT_THAT(made(make()), HasSubstr("descriptor"));
  fs::remove(experiment_.out("weights.bin"));
  const ShellResult missing = make();
  EXPECT_NE(missing.code, 0);
  EXPECT_THAT(missing.text, HasSubstr(experiment_.out("weights.bin").string()));
  write("mine.toml", "robots = []\n", table + "reconstruction_range = [1, 1]\n");
  EXPECT_THAT(make().text, HasSubstr("descriptor.onnx.reconstruction_range: expected two different numbers"));
}

}  // namespace
}  // namespace hbr
