// Which tensor of a network is read as the position.
#include "models/onnx/tensors.h"

#include <gmock/gmock.h>

#include "tests/models/autoencoder/images.h"
#include "tests/models/descriptor/contract.h"
#include "tests/models/onnx/other_networks.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

OnnxSettings named(const std::string& position, const std::string& reconstruction = "") {
  OnnxSettings settings;
  settings.position = position;
  settings.reconstruction = reconstruction;
  return settings;
}

const OtherAutoencoder& network() {
  static const OtherAutoencoder made(2);
  return made;
}

other::File begun() {
  other::File file;
  file.input("flat", {-1, 784});
  return file;
}

// A second head beside the position: the logarithm of the variance.
const DenseLayer& logvar() {
  static const DenseLayer head("logvar", 16, 2);
  return head;
}
std::string two_heads(bool outputs) {
  other::File file = begun();
  network().encoder(file);
  logvar().add(file, "hr", "logvar");
  network().decoder(file);
  if (outputs) file.output("z", {-1, 2}).output("logvar", {-1, 2});
  return file.content();
}

TEST(OnnxTensors, OfTwoHeadsThatAreOutputsOneIsToBeNamed) {
  EXPECT_THAT(
      complaint(two_heads(true)),
      AllOf(HasSubstr("'z' (1 x 2, an output, all of the reconstruction passes through it)"),
            HasSubstr("'logvar' (1 x 2, an output)"), HasSubstr("position = 'z' of [descriptor.onnx]")));
  expect_network(OnnxDescriptor(two_heads(true), "mine.onnx", named("z")), network(), some_images());
  const OnnxDescriptor other(two_heads(true), "mine.onnx", named("logvar"));
  expect_near(reconstructed(other, some_images()).position, logvar().of(network().hidden(some_images())));
  expect_network(OnnxDescriptor(two_heads(false), "mine.onnx"), network(), some_images());
}

// Files of ONNX's first versions list weights among the inputs.
TEST(OnnxTensors, ThatAreWeightsAreNoInputs) {
  other::File file = begun();
  network().encoder(file);
  network().decoder(file).input("in.weight", {16, 784}).input("code.bias", {2});
  expect_network(OnnxDescriptor(file.content(), "mine.onnx"), network(), some_images());
}

// What is named is kept with the network.
TEST(OnnxTensors, ThatAreNamedStayNamed) {
  const TemporaryFolder folder;
  const OnnxDescriptor made(two_heads(true), "mine.onnx", named("logvar"));
  const OnnxDescriptor read = read_back(made, folder.path() / "onnx.h5");
  EXPECT_EQ(read.settings().position, "logvar");
  EXPECT_EQ(read.settings().reconstruction, "recon");
  EXPECT_TRUE(describe(read, some_images()) == describe(made, some_images()));
}

// Squeeze and excite: a gate by a narrow layer beside the way.
struct Gated {
  explicit Gated(int d, int narrow)
      : coder(d), squeeze("squeeze", 16, narrow), excite("excite", narrow, 16) {}
  std::string content() const {
    other::File file = begun();
    coder.in.add(file, "flat", "h").node("Relu", {"h"}, {"hr"});
    squeeze.add(file, "hr", "s").node("Relu", {"s"}, {"sr"});
    excite.add(file, "sr", "e").node("Sigmoid", {"e"}, {"gate"}).node("Mul", {"hr", "gate"}, {"gated"});
    coder.code.add(file, "gated", "z");
    return coder.decoder(file).content();
  }
  Rows position(const Rows& x) const {
    const Rows h = coder.hidden(x), gate = sigmoid(excite.of(relu(squeeze.of(h))));
    return coder.code.of(h.cwiseProduct(gate));
  }
  OtherAutoencoder coder;
  DenseLayer squeeze, excite;
};

TEST(OnnxTensors, OfAttentionAreNotTakenForThePosition) {
  for (const int narrow : {2, 3}) {
    const Gated gated(3, narrow);
    EXPECT_THAT(complaint(gated.content()),
                AllOf(HasSubstr("which tensor is the position is not clear: 'z' (1 x 3, all of the"),
                      HasSubstr(fmt::format("'s' (1 x {}), 'sr' (1 x {}); name it", narrow, narrow))));
    const OnnxDescriptor read(gated.content(), "mine.onnx", named("z"));
    const Reconstructed found = reconstructed(read, some_images());
    expect_near(found.position, gated.position(some_images()));
    expect_near(found.decoded, gated.coder.decoded(gated.position(some_images())));
  }
  // A wider one is no candidate.
  const Gated wide(3, 4);
  const OnnxDescriptor read(wide.content(), "mine.onnx");
  EXPECT_EQ(read.settings().position, "z");
  expect_near(reconstructed(read, some_images()).position, wide.position(some_images()));
}

TEST(OnnxTensors, OfEqualSizeAreOnePlaceUnlessWeightsAreBetween) {
  other::File file = begun();
  network()
      .encoder(file)
      .node("Tanh", {"z"}, {"t"})
      .node("Sigmoid", {"t"}, {"s"})
      .node("Mul", {"t", "s"}, {"swish"});
  network().decoder(file, "swish");
  const OnnxDescriptor read(file.content(), "mine.onnx");
  EXPECT_EQ(read.settings().position, "swish");
  const Rows t = network().position(some_images()).array().tanh();
  expect_near(reconstructed(read, some_images()).position, t.cwiseProduct(sigmoid(t)));

  const DenseLayer turn("turn", 2, 2);
  other::File turned = begun();
  network().encoder(turned).node("Tanh", {"z"}, {"t"});
  turn.add(turned, "t", "turned");
  network().decoder(turned, "turned");
  EXPECT_THAT(
      complaint(turned.content()),
      AllOf(HasSubstr("'t' (1 x 2, all of"), HasSubstr("'turned' (1 x 2, all of"), Not(HasSubstr("'z'"))));
  const OnnxDescriptor named_one(turned.content(), "mine.onnx", named("t"));
  expect_near(reconstructed(named_one, some_images()).position, t);
  expect_near(reconstructed(named_one, some_images()).decoded, network().decoded(turn.of(t)));
}

// The variance alone as output, beside the mean on the way.
TEST(OnnxTensors, AnOutputThatIsNotOnTheWayIsInDoubt) {
  other::File file = begun();
  network().encoder(file);
  logvar().add(file, "hr", "logvar");
  network().decoder(file).output("logvar", {-1, 2});
  EXPECT_THAT(complaint(file.content()),
              AllOf(HasSubstr("'z' (1 x 2, all of"), HasSubstr("'logvar' (1 x 2, an output)")));

  // A code that is too wide leaves the output as the only one.
  const OtherAutoencoder wide(12);
  other::File two = begun();
  wide.encoder(two);
  logvar().add(two, "hr", "place");
  wide.decoder(two).output("place", {-1, 2});
  const OnnxDescriptor read(two.content(), "mine.onnx");
  expect_near(reconstructed(read, some_images()).position, logvar().of(wide.hidden(some_images())));
}

TEST(OnnxTensors, ShapesAreNoWayAroundThePosition) {
  const OtherAutoencoder& n = network();
  other::File file;
  file.input("image", {-1, 1, 28, 28})
      .node("Shape", {"image"}, {"shape"})
      .node("Flatten", {"image"}, {"flat"}, other::integer_attribute("axis", 1));
  n.encoder(file);
  n.back.add(file, "z", "g").node("Relu", {"g"}, {"gr"});
  n.out.add(file, "gr", "o").node("Sigmoid", {"o"}, {"r"}).node("Reshape", {"r", "shape"}, {"recon"});
  file.output("recon", {-1, 1, 28, 28});
  const OnnxDescriptor read(file.content(), "mine.onnx");
  EXPECT_EQ(read.settings().position, "z");
  expect_network(read, n, some_images());
}

// The number of a class is as narrow as a position, and none.
TEST(OnnxTensors, OfIntegersAreNotTakenForThePosition) {
  other::File file = begun();
  network().encoder(file);
  network().decoder(file).node("ArgMax", {"hr"}, {"class"}, other::integer_attribute("axis", 1));
  file.output("class", {-1, 1}, other::kInt64);
  const OnnxDescriptor read(file.content(), "mine.onnx");
  EXPECT_EQ(read.settings().position, "z");
  expect_network(read, network(), some_images());
  EXPECT_THAT(complaint(file.content(), named("class")), HasSubstr("'class' is not of type float32"));
}

TEST(OnnxTensors, OfSeveralReconstructionsOneIsToBeNamed) {
  other::File file = begun();
  network().encoder(file);
  network().decoder(file).output("o", {-1, 784});
  EXPECT_THAT(complaint(file.content()), AllOf(HasSubstr("found outputs of 'recon' (1 x 784), 'o' (1 x 784)"),
                                               HasSubstr("name the reconstruction in the profile")));
  expect_network(OnnxDescriptor(file.content(), "mine.onnx", named("", "recon")), network(), some_images());
  const OnnxDescriptor logits(file.content(), "mine.onnx", named("", "o"));
  const Rows z = network().position(some_images());
  expect_near(reconstructed(logits, some_images()).decoded, network().out.of(relu(network().back.of(z))));
}

TEST(OnnxTensors, ThatAreNamedMustFit) {
  const std::string content = two_heads(true);
  EXPECT_THAT(complaint(content, named("zz")),
              AllOf(HasSubstr("position = 'zz': no tensor of this name is made of the image"),
                    HasSubstr("did you mean 'z'"), HasSubstr("its outputs are recon, z, logvar")));
  EXPECT_THAT(complaint(content, named("/z/Gemm")),
              HasSubstr("is the name of a node; expected that of a tensor: it makes 'z'"));
  EXPECT_THAT(complaint(content, named("flat")), HasSubstr("no tensor of this name is made of the image"));
  EXPECT_THAT(complaint(content, named("code.weight")),
              HasSubstr("no tensor of this name is made of the image"));
  EXPECT_THAT(complaint(content, named("hr")),
              HasSubstr("position = 'hr' has 16 numbers an image (1 x 16); expected 1 to 8"));
  EXPECT_THAT(complaint(content, named("z", "hr")),
              HasSubstr("reconstruction = 'hr' has 16 numbers an image (1 x 16); expected 784"));
  EXPECT_THAT(complaint(content, named("z", "mean")), HasSubstr("reconstruction = 'mean': no tensor"));
}

// Around the narrow layer goes a connection: the reconstruction does not pass through it.
TEST(OnnxTensors, BesideAConnectionThatSkipsThemAreNamedOrRefused) {
  const auto content = [](const OtherAutoencoder& n) {
    other::File file = begun();
    n.encoder(file);
    n.back.add(file, "z", "g").node("Add", {"g", "hr"}, {"sum"});
    n.out.add(file, "sum", "recon").output("recon", {-1, 784});
    return file.content();
  };
  EXPECT_THAT(complaint(content(network())), HasSubstr("is not clear: 'z' (1 x 2); name it"));
  const OnnxDescriptor read(content(network()), "mine.onnx", named("z"));
  const Rows z = network().position(some_images());
  expect_near(reconstructed(read, some_images()).position, z);
  expect_near(reconstructed(read, some_images()).decoded,
              network().out.of(network().back.of(z) + network().hidden(some_images())));
  EXPECT_THAT(complaint(content(OtherAutoencoder(9))),
              HasSubstr("its narrowest layer, 'sum', has 16 numbers"));
}

}  // namespace
}  // namespace hbr
