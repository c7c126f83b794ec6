// Networks to and from ONNX files, OpenCV being the other reader.
#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <opencv2/core/version.hpp>
#include <opencv2/dnn.hpp>

#include "models/autoencoder/autoencoder.h"
#include "models/onnx/export.h"
#include "models/onnx/file/fields.h"
#include "models/onnx/graph.h"
#include "models/onnx/onnx_descriptor.h"
#include "pipeline/core/check.h"
#include "tests/models/autoencoder/images.h"
#include "tests/models/descriptor/contract.h"
#include "tests/models/onnx/other_writer.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::HasSubstr;

Autoencoder untrained(int latent, net::Activations activations = {0.1f}) {
  net::Network network(latent, activations);
  network.initialise(Seed(3), -2.f);
  // Biases that differ, so that the export can't mix them up.
  for (const net::Layer& l : network.layout.layers)
    for (net::Index o = 0; o < l.outputs; ++o)
      network.parameters[static_cast<std::size_t>(l.bias + o)] += 0.02f * static_cast<float>(o % 7 - 3);
  network.refresh();
  return Autoencoder(std::move(network));
}

std::vector<cv::Mat> run(const std::string& model, const cv::Mat& input,
                         const std::vector<std::string>& outputs) {
  cv::dnn::Net net = cv::dnn::readNetFromONNX(model.data(), model.size());
  net.setInput(input);
  std::vector<cv::Mat> values;
  net.forward(values, outputs);
  return values;
}

double greatest_difference(const cv::Mat& found, const std::vector<float>& expected) {
  EXPECT_EQ(found.total(), expected.size());
  double greatest = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    greatest = std::max<double>(greatest, std::abs(found.ptr<float>()[i] - expected[i]));
  return greatest;
}

TEST(OnnxExport, GivesOpenCvOurNumbers) {
  constexpr int n = 5;
  std::vector<float> images = as_floats(stroke_images(n, Seed(1)));
  for (const auto& [dim, activations] : std::vector<std::pair<int, net::Activations>>{
           {1, {0.1f}}, {2, {0.1f}}, {8, {0.1f}}, {2, {.tanh_hidden = true}}, {2, {.linear_output = true}}}) {
    const Autoencoder autoencoder = untrained(dim, activations);
    std::vector<float> position(static_cast<std::size_t>(n * dim)), decoded(n * 784);
    autoencoder.encode(n, images.data(), position.data());
    autoencoder.decode(n, position.data(), decoded.data());
    const cv::Mat input(std::vector<int>{n, 1, 28, 28}, CV_32F, images.data());
    const cv::Mat places(n, dim, CV_32F, position.data());

    const auto whole = run(onnx_whole(autoencoder.network()), input, {"position", "decoded"});
    EXPECT_LT(greatest_difference(whole[0], position), 2e-6) << dim;
    EXPECT_LT(greatest_difference(whole[1], decoded), 2e-6) << dim;
    const auto encoder = run(onnx_encoder(autoencoder.network()), input, {"position"});
    EXPECT_LT(greatest_difference(encoder[0], position), 2e-6) << dim;
    const auto decoder = run(onnx_decoder(autoencoder.network()), places, {"decoded"});
    EXPECT_LT(greatest_difference(decoder[0], decoded), 2e-6) << dim;
  }
}

// What a file says of itself, read field by field: metadata_props and the doc strings of inputs and outputs.
TEST(OnnxExport, SaysWhatItsInputsAndOutputsAre) {
  const auto network = untrained(2);
  const auto fields = [](std::string_view bytes, int number) {
    std::vector<std::string> found;
    Field f;
    for (FieldReader reader(bytes); reader.next(f);)
      if (f.number == number) found.emplace_back(f.bytes);
    return found;
  };
  for (const std::string& model :
       {onnx_encoder(network.network()), onnx_decoder(network.network()), onnx_whole(network.network())}) {
    EXPECT_THAT(fields(model, 2), testing::ElementsAre("hbr"));
    std::map<std::string, std::string> told;
    for (const std::string& entry : fields(model, 14)) told[fields(entry, 1).at(0)] = fields(entry, 2).at(0);
    EXPECT_THAT(told["description"], HasSubstr("autoencoder"));
    const std::string graph = fields(model, 7).at(0);
    for (const int kind : {11, 12})
      for (const std::string& value : fields(graph, kind)) {
        const std::string name = fields(value, 1).at(0), meaning = fields(value, 3).at(0);
        EXPECT_EQ(meaning, told.at(name));
        EXPECT_THAT(meaning, HasSubstr(name == "position" ? "from -1 to 1" : "from 0"));
      }
  }
}

TEST(OnnxDescriptor, IsTheNetworkThatWasExported) {
  const Rows images = as_images(stroke_images(20, Seed(2)));
  for (const int dim : {1, 2, 3, 8}) {
    const Autoencoder autoencoder = untrained(dim);
    const OnnxDescriptor imported(onnx_whole(autoencoder.network()), "whole.onnx");
    ASSERT_EQ(imported.dimension(), dim);
    const Described expected = describe(autoencoder, images), found = describe(imported, images);
    for (std::size_t i = 0; i < expected.position.size(); ++i)
      EXPECT_NEAR(found.position[i], expected.position[i], 2e-6);
    for (std::size_t i = 0; i < expected.error.size(); ++i)
      EXPECT_NEAR(found.error[i], expected.error[i], 1e-6);
  }
}

TEST(OnnxDescriptor, EveryImageStandsAlone) {
  const OnnxDescriptor imported(onnx_whole(untrained(2).network()), "whole.onnx");
  expect_images_stand_alone(imported, as_images(stroke_images(40, Seed(3))));
}

// As other tools write them: dense layers by Gemm or by MatMul and Add, a single output.
struct Dense {
  Dense(int inputs, int latent, int outputs) : encoder(latent, inputs), decoder(outputs, latent) {
    Rng rng{Seed(4)};
    for (float& w : encoder.reshaped()) w = rng.uniform(-0.2f, 0.2f);
    for (float& w : decoder.reshaped()) w = rng.uniform(-0.5f, 0.5f);
  }
  static void add(OnnxGraph& graph, const std::string& name, const Rows& matrix) {
    graph.weights(name, {matrix.rows(), matrix.cols()}, {matrix.data(), matrix.data() + matrix.size()});
  }
  std::string gemm(const std::vector<std::int64_t>& image) const {
    OnnxGraph graph;
    graph.input("x", image);
    add(graph, "w1", encoder);
    add(graph, "w2", decoder);
    std::string flat = "x";
    if (image.size() > 1) graph.node("Flatten", {"x"}, flat = "flat");
    graph.node("Gemm", {flat, "w1"}, "z", {{"transB", std::int64_t{1}}});
    graph.node("Gemm", {"z", "w2"}, "y", {{"transB", std::int64_t{1}}});
    graph.output("y", {decoder.rows()});
    return graph.bytes();
  }
  std::string matmul() const {
    OnnxGraph graph;
    graph.input("x", {encoder.cols()});
    add(graph, "w1", encoder.transpose());
    graph.weights("b1", {encoder.rows()},
                  std::vector<float>(static_cast<std::size_t>(encoder.rows()), 0.25f));
    add(graph, "w2", decoder.transpose());
    graph.node("MatMul", {"x", "w1"}, "h");
    graph.node("Add", {"h", "b1"}, "k");
    graph.node("Tanh", {"k"}, "z");
    graph.node("MatMul", {"z", "w2"}, "y");
    graph.output("y", {decoder.rows()});
    return graph.bytes();
  }
  Rows encoder, decoder;  // [outputs x inputs]
};

TEST(OnnxDescriptor, DenseNetworksOfOneOutputAreReadAtTheirNarrowest) {
  const Rows images = as_images(stroke_images(20, Seed(5)));
  const Dense dense(784, 3, 784);
  const Rows z = images * dense.encoder.transpose();
  const auto check = [&](const std::string& model, const Rows& places) {
    const OnnxDescriptor imported(model, "dense.onnx");
    ASSERT_EQ(imported.dimension(), 3);
    Rows position(images.rows(), 3), decoded(images.rows(), 784);
    imported.reconstruct(images.rows(), images.data(), position.data(), decoded.data());
    EXPECT_LT((position - places).cwiseAbs().maxCoeff(), 1e-4);
    EXPECT_LT((decoded - places * dense.decoder.transpose()).cwiseAbs().maxCoeff(), 1e-4);
    expect_images_stand_alone(imported, images);
  };
  check(dense.gemm({784}), z);
  check(dense.gemm({1, 28, 28}), z);
  check(dense.matmul(), (z.array() + 0.25f).tanh());
}

TEST(OnnxDescriptor, PositionsBeyondTheUnitBoxAreScaledIntoIt) {
  const TemporaryFolder folder;
  const Rows images = as_images(stroke_images(12, Seed(5)));
  Dense dense(784, 2, 784);
  dense.encoder *= 10;
  OnnxDescriptor imported(dense.gemm({784}), "dense.onnx");
  Rows raw(12, 2), position(12, 2), decoded(12, 784);
  imported.reconstruct(12, images.data(), raw.data(), decoded.data());
  imported.place(raw / raw.cwiseAbs().maxCoeff());
  imported.reconstruct(12, images.data(), position.data(), decoded.data());
  EXPECT_EQ(position, raw);
  ASSERT_GT(raw.cwiseAbs().maxCoeff(), 1);
  imported.place(raw);
  imported.reconstruct(12, images.data(), position.data(), decoded.data());
  for (int d = 0; d < 2; ++d) {
    EXPECT_NEAR(position.col(d).minCoeff(), -1, 1e-5);
    EXPECT_NEAR(position.col(d).maxCoeff(), 1, 1e-5);
  }
  const OnnxDescriptor read = read_back(imported, folder.path() / "onnx.h5");
  EXPECT_TRUE(describe(read, images) == describe(imported, images));
}

TEST(OnnxDescriptor, PositionsThatDoNotVaryAreRefused) {
  const Rows images = as_images(stroke_images(12, Seed(5)));
  Dense dense(784, 3, 784);
  dense.encoder.row(1).setZero();
  OnnxDescriptor imported(dense.gemm({784}), "mine.onnx");
  Rows raw(12, 3), decoded(12, 784);
  imported.reconstruct(12, images.data(), raw.data(), decoded.data());
  const auto placed = [&] { imported.place(raw); };
  EXPECT_THAT(placed, testing::ThrowsMessage<InputError>(
                          HasSubstr("mine.onnx: coordinate 2 (of 3) of the position 'z' is 0 for all 12 "
                                    "training images: they differ by 0,")));
  for (const float spread : {1e-6f, 1e-5f}) {
    raw.col(1).setConstant(3);
    raw(4, 1) += spread;
    if (spread > 3e-6f)
      EXPECT_NO_THROW(placed());
    else
      EXPECT_THAT(placed, testing::ThrowsMessage<InputError>(HasSubstr("coordinate 2 (of 3)")));
  }
}

TEST(OnnxDescriptor, OfAFileThatEndsOpenCvIsRefused) {
  OnnxGraph graph;
  graph.input("x", {784});
  graph.weights("w1", {784, 0}, {});  // OpenCV 4.6 divides by their number; later ones throw
  graph.node("Gemm", {"x", "w1"}, "z");
  graph.output("z", {0});
  const std::string crash = std::string(CV_VERSION) == "4.6.0" ? "the reader crashed on it" : "";
  EXPECT_THAT([&] { OnnxDescriptor(graph.bytes(), "mine.onnx"); },
              testing::ThrowsMessage<InputError>(
                  HasSubstr("can't run the operator Gemm (node 'z', which makes 'z'): " + crash)));
}

TEST(OnnxDescriptor, SaysInOneLineWhatIsWrong) {
  const Rows images = as_images(stroke_images(1, Seed(5)));
  const auto complaint = [&](const std::string& model) {
    try {
      describe(OnnxDescriptor(model, "mine.onnx"), images);
      return std::string("accepted");
    } catch (const InputError& error) {
      EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
      return std::string(error.what());
    }
  };
  const std::string whole = onnx_whole(untrained(2).network());
  for (const std::string& junk : {std::string(), std::string("hello"), whole.substr(0, whole.size() / 2)})
    EXPECT_THAT(complaint(junk), HasSubstr("mine.onnx: not an ONNX network"));
  EXPECT_THAT(complaint(Dense(100, 2, 784).gemm({100})),
              HasSubstr("expected a network that takes images n x 784, n x 1 x 28 x 28, "));
  EXPECT_THAT(complaint(Dense(784, 2, 100).gemm({784})),
              HasSubstr("expected one output of 784 numbers an image, found outputs of 'y' (1 x 100)"));
  EXPECT_THAT(complaint(Dense(784, 9, 784).gemm({784})),
              HasSubstr("has 9 numbers an image; expected 1 to 8"));
  EXPECT_THAT(complaint(onnx_encoder(untrained(2).network())),
              HasSubstr("found outputs of 'position' (1 x 2)"));
  EXPECT_THAT(complaint(other::File().input("x", {-1, 784}).node("Relu", {"y"}, {"z"}).content()),
              HasSubstr("reads 'y', which nothing before it makes"));
  Dense broken(784, 2, 784);
  broken.decoder(5, 1) = std::numeric_limits<float>::infinity();
  EXPECT_THAT(complaint(broken.gemm({784})),
              HasSubstr("mine.onnx: what the network makes of an image is not a finite number"));
}

}  // namespace
}  // namespace hbr
