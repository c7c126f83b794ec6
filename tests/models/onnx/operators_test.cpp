// Networks that OpenCV can't run: what the user is told.
#include <gmock/gmock.h>

#include "tests/models/onnx/other_networks.h"

namespace hbr {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// A network with one more node, from the position to what the decoder reads.
std::string with_node(const std::string& operation, const std::string& attributes = "",
                      const std::string& domain = "") {
  const OtherAutoencoder network(2);
  other::File file;
  file.input("flat", {-1, 784});
  network.encoder(file).node("Tanh", {"z"}, {"t"}).node(operation, {"t"}, {"y"}, attributes, domain);
  return network.decoder(file, "y").content();
}

TEST(OnnxOperators, ThatOpenCvLacksAreNamedWithTheirNode) {
  EXPECT_THAT(complaint(with_node("Frobnicate")),
              AllOf(HasSubstr("can't run the operator Frobnicate (node '/y/Frobnicate', which makes 'y')"),
                    HasSubstr("export the network with other operators for it")));
  EXPECT_THAT(complaint(with_node("aten_tanh", "", "pkg.torch")),
              AllOf(HasSubstr("operator aten_tanh (node"), HasSubstr("not ONNX's own but of 'pkg.torch'")));

  const OtherAutoencoder network(2);
  other::File sampled;
  sampled.input("flat", {-1, 784});
  network.encoder(sampled).node("RandomNormalLike", {"z"}, {"noise"}).node("Add", {"z", "noise"}, {"sample"});
  EXPECT_THAT(complaint(network.decoder(sampled, "sample").content()),
              AllOf(HasSubstr("operator RandomNormalLike (node"), HasSubstr("without sampling")));
}

TEST(OnnxOperators, ThatOpenCvCannotRunInThisWayAreNamedWithItsReason) {
  const OtherAutoencoder network(2);
  other::File file;
  file.input("image", {-1, 1, 28, 28}).floats("kernel", {4, 2, 3, 3}, std::vector<float>(72, 0.1f));
  file.node("Relu", {"image"}, {"r"}).node("Conv", {"r", "kernel"}, {"c"}).node("Flatten", {"c"}, {"flat"});
  network.encoder(file);
  const std::string line = complaint(network.decoder(file).content());
  EXPECT_THAT(line, HasSubstr("operator Conv (node '/c/Conv', which makes 'c'): "));
  for (const char* word : {"error:", "in function", ".cpp", "OpenCV("})
    EXPECT_EQ(line.find(word), std::string::npos) << line;
}

// Nodes that nothing needs may be what they like, once all that is needed is named.
TEST(OnnxOperators, BesideTheWayDoNotMatterWhereBothTensorsAreNamed) {
  const OtherAutoencoder network(2);
  other::File file;
  file.input("flat", {-1, 784});
  network.encoder(file).node("Frobnicate", {"z"}, {"side"});
  const std::string content = network.decoder(file).output("side", {-1, 2}).content();
  EXPECT_THAT(complaint(content), HasSubstr("operator Frobnicate"));
  OnnxSettings settings;
  settings.position = "z";
  settings.reconstruction = "recon";
  EXPECT_EQ(complaint(content, settings), "accepted: z");
}

}  // namespace
}  // namespace hbr
