// How images get into networks, and the ranges of their numbers.
#include <gmock/gmock.h>

#include "tests/models/autoencoder/images.h"
#include "tests/models/descriptor/contract.h"
#include "tests/models/onnx/other_networks.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::HasSubstr;

TEST(OnnxInput, OfAnyShapeOf784NumbersIsReadFromTheFile) {
  const OtherAutoencoder network(2);
  for (const std::vector<int>& shape : std::vector<std::vector<int>>{{-1, 784},
                                                                     {0, 784},
                                                                     {1, 784},
                                                                     {-1, 1, 28, 28},
                                                                     {1, 1, 28, 28},
                                                                     {64, 1, 28, 28},
                                                                     {-1, 28, 28, 1},
                                                                     {1, 28, 28, 1},
                                                                     {-1, 28, 28},
                                                                     {-1, -1, 28, 28},
                                                                     {-1, -1, -1, -1},
                                                                     {-1, -1}}) {
    const OnnxDescriptor read(network.content(shape), "mine.onnx");
    ASSERT_EQ(read.settings().input_shape.size(), shape.size());
    EXPECT_EQ(read.settings().input_shape.front(), 1);
    expect_network(read, network, some_images());
  }
}

// A convolution tells channels from pixels.
struct Convolution {
  Convolution()
      : kernel(random_matrix(4, 9, "kernel", 0.5f)),
        code("code", 4 * 14 * 14, 2, 0.05f),
        out("out", 2, 784) {}
  std::string content(other::File file, bool channels_last) const {
    std::string from = "image";
    if (channels_last)
      file.node("Transpose", {"image"}, {from = "nchw"}, other::integers_attribute("perm", {0, 3, 1, 2}));
    file.floats("kernel", {4, 1, 3, 3}, numbers_of(kernel))
        .node("Conv", {from, "kernel"}, {"c"},
              other::integers_attribute("kernel_shape", {3, 3}) +
                  other::integers_attribute("strides", {2, 2}) +
                  other::integers_attribute("pads", {1, 1, 1, 1}))
        .node("Flatten", {"c"}, {"flat"}, other::integer_attribute("axis", 1));
    code.add(file, "flat", "z");
    return out.add(file, "z", "recon").output("recon", {-1, 784}).content();
  }
  Rows position(const Rows& x) const {
    Rows c = Rows::Zero(x.rows(), 4 * 14 * 14);
    for (Eigen::Index i = 0; i < x.rows(); ++i)
      for (int k = 0; k < 4 * 14 * 14; ++k)
        for (int tap = 0; tap < 9; ++tap) {
          const int row = k / 14 % 14 * 2 + tap / 3 - 1, column = k % 14 * 2 + tap % 3 - 1;
          if (row >= 0 && column >= 0 && row < 28 && column < 28)
            c(i, k) += kernel(k / 196, tap) * x(i, row * 28 + column);
        }
    return code.of(c);
  }
  Rows kernel;
  DenseLayer code, out;
};

TEST(OnnxInput, WithChannelsFirstOrLast) {
  const Convolution network;
  const Rows z = network.position(some_images());
  for (const int batch : {-1, 1}) {
    const OnnxDescriptor first(network.content(other::File().input("image", {batch, 1, 28, 28}), false),
                               "mine.onnx"),
        last(network.content(other::File().input("image", {batch, 28, 28, 1}), true), "mine.onnx");
    for (const OnnxDescriptor* read : {&first, &last}) {
      expect_near(reconstructed(*read, some_images()).position, z);
      expect_near(reconstructed(*read, some_images()).decoded, network.out.of(z));
      expect_images_stand_alone(*read, as_images(stroke_images(20, Seed(6))));
    }
  }
}

// Where the file leaves it open, the shape that the network takes; told, or tried.
TEST(OnnxInput, OfAnOpenShapeIsTried) {
  const Convolution network;
  for (const bool last : {false, true}) {
    const OnnxDescriptor read(network.content(other::File().input_without_shape("image"), last), "mine.onnx");
    EXPECT_EQ(read.settings().input_shape,
              last ? (std::vector<int>{1, 28, 28, 1}) : (std::vector<int>{1, 1, 28, 28}));
    expect_near(reconstructed(read, some_images()).position, network.position(some_images()));
  }
  OnnxSettings settings;
  settings.input_shape = {1, 28, 28, 1};
  const std::string open = network.content(other::File().input("image", {-1, -1, -1, -1}), true);
  expect_near(reconstructed(OnnxDescriptor(open, "mine.onnx", settings), some_images()).position,
              network.position(some_images()));
  settings.input_shape = {1, 784};
  EXPECT_THAT(complaint(open, settings),
              HasSubstr("input_shape = [1, 784], but its input 'image' is ? x ? x ? x ?"));
  settings.input_shape = {1, 28};
  EXPECT_THAT(complaint(open, settings), HasSubstr("input_shape: expected sizes that make 784 numbers"));
  settings.input_shape = {784, 784};
  EXPECT_THAT(complaint(open, settings), HasSubstr("input_shape: expected sizes that make 784 numbers"));
}

// A sum over the last axis is another of rows, of columns and of channels.
TEST(OnnxInput, OfSeveralShapesThatAllRunIsNotGuessed) {
  const auto content = [](const other::File& begun) {
    other::File file = begun;
    const DenseLayer code("sums", 784, 2), out("out", 2, 784);
    file.node("Softmax", {"image"}, {"s"}, other::integer_attribute("axis", 3))
        .node("Flatten", {"s"}, {"flat"}, other::integer_attribute("axis", 1));
    code.add(file, "flat", "z");
    return out.add(file, "z", "recon").output("recon", {-1, 784}).content();
  };
  const std::string open = content(other::File().input("image", {-1, -1, -1, -1}));
  EXPECT_THAT(complaint(open), HasSubstr("takes images of the shapes 1 x 1 x 28 x 28 and 1 x 28 x 28 x 1, "
                                         "with different results; set input_shape"));
  OnnxSettings settings;
  settings.input_shape = {1, 1, 28, 28};
  const OnnxDescriptor told(open, "mine.onnx", settings),
      known(content(other::File().input("image", {-1, 1, 28, 28})), "mine.onnx");
  EXPECT_EQ(reconstructed(told, some_images()).position, reconstructed(known, some_images()).position);
}

TEST(OnnxInput, ThatIsNoImageIsRefused) {
  const OtherAutoencoder network(2);
  for (const auto& [shape, text] : std::vector<std::pair<std::vector<int>, std::string>>{
           {{-1, 3, 32, 32}, "? x 3 x 32 x 32"}, {{-1, 100}, "? x 100"}, {{2, 28, 28, 3}, "2 x 28 x 28 x 3"}})
    EXPECT_THAT(complaint(network.content(shape)), HasSubstr("its input 'image' is " + text));
  EXPECT_THAT(complaint(network.content({-1, 784}, 2)),
              HasSubstr("its input 'image' is of the type 2 of onnx.proto; expected real numbers"));
  other::File two;
  two.input("flat", {-1, 784}).input("noise", {-1, 2});
  network.encoder(two).node("Add", {"z", "noise"}, {"sample"});
  network.decoder(two, "sample");
  EXPECT_THAT(complaint(two.content()),
              HasSubstr("expected a network of one input, images; found 2: 'flat', 'noise'"));
}

TEST(OnnxInput, OfAnyRangeOfNumbers) {
  const OtherAutoencoder network(2);
  const std::string content = network.content({-1, 784});
  const TemporaryFolder folder;
  for (const auto& [black, white] :
       std::vector<std::pair<double, double>>{{0, 255}, {-1, 1}, {1, 0}, {-0.4242, 2.8215}}) {
    OnnxSettings settings;
    settings.input_range = {black, white};
    settings.reconstruction_range = {0.25, -3};
    const OnnxDescriptor read(content, "mine.onnx", settings);
    const Rows x = (static_cast<float>(white - black) * some_images()).array() + static_cast<float>(black);
    const Rows z = network.position(x);
    const Reconstructed found = reconstructed(read, some_images());
    const float size = std::max(1.f, z.cwiseAbs().maxCoeff());
    expect_near(found.position, z, 1e-5f * size);
    expect_near(found.decoded, (network.decoded(z).array() - 0.25f) / -3.25f, 1e-4f);
    EXPECT_TRUE(describe(read_back(read, folder.path() / "onnx.h5"), some_images()) ==
                describe(read, some_images()));
  }
  OnnxSettings settings;
  for (const std::vector<double>& range : std::vector<std::vector<double>>{{}, {1}, {1, 1}, {0, 1, 2}}) {
    settings.input_range = range;
    EXPECT_THAT(complaint(content, settings), HasSubstr("input_range: expected two different numbers"));
    settings.input_range = {0, 1};
    settings.reconstruction_range = range;
    EXPECT_THAT(complaint(content, settings),
                HasSubstr("reconstruction_range: expected two different numbers"));
  }
}

}  // namespace
}  // namespace hbr
