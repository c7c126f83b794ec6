// Weights beside the file, and of other types.
#include "models/onnx/file/weights.h"

#include <gmock/gmock.h>

#include <Eigen/Core>
#include <fstream>

#include "models/onnx/file/model.h"
#include "tests/models/descriptor/contract.h"
#include "tests/models/onnx/other_networks.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

void write(const fs::path& path, const std::string& content) {
  std::ofstream(path, std::ios::binary) << content;
}

// The n float32 that a file of nothing but these weights holds after reading.
std::vector<float> floats_of(std::size_t n, const std::string& tensor, const fs::path& file = "mine.onnx") {
  const std::string plain =
      plain_weights(other::File().weights(tensor).node("Relu", {"w"}, {"y"}).content(), file);
  const std::string weights = parse_onnx(plain).weights.at("w");
  EXPECT_NE(weights.find("\x10\x01"), std::string::npos);  // data_type: float
  std::vector<float> floats(n);
  const std::string end = other::raw_data(std::string(4 * n, ' ')).substr(0, 2);  // raw_data stands last
  EXPECT_EQ(weights.substr(weights.size() - 4 * n - 2, 2), end);
  std::memcpy(floats.data(), &weights[weights.size() - 4 * n], 4 * n);
  return floats;
}

class OnnxWeights : public testing::Test {
 protected:
  // Writes all weights into one file, one after the other.
  void put_beside(OtherAutoencoder& network, const std::string& location) {
    network.written_by(
        [this, location](const std::string& name, const std::vector<int>& dims, const Rows& m) {
          const std::string here = other::raw(numbers_of(m));
          beside_ += std::string(name.size(), '-');  // a gap
          const std::string data =
              other::in_file(location, std::to_string(beside_.size()), std::to_string(here.size()));
          beside_ += here;
          return other::tensor(name, other::kFloat, dims, data);
        });
  }
  std::string refused(const std::string& data, const std::vector<int>& dims = {3}) const {
    try {
      plain_weights(other::File().weights(other::tensor("w", other::kFloat, dims, data)).content(),
                    folder_.path() / "mine.onnx");
      return "accepted";
    } catch (const InputError& error) {
      return error.what();
    }
  }
  TemporaryFolder folder_;
  std::string beside_;
};

TEST_F(OnnxWeights, BesideTheFileAreRead) {
  const Rows& images = some_images();
  OtherAutoencoder network(2);
  fs::create_directories(folder_.path() / "below");
  put_beside(network, "below/weights.bin");
  const std::string content = network.content({-1, 1, 28, 28}), file = folder_.path() / "mine.onnx";
  write(folder_.path() / "below/weights.bin", beside_);
  write(file, content);
  const OnnxDescriptor read(content, file);
  expect_network(read, network, images);
  EXPECT_THAT(weight_files(file), testing::ElementsAre(folder_.path() / "below/weights.bin"));

  // What is kept of it needs them no more.
  fs::remove_all(folder_.path() / "below");
  const OnnxDescriptor again = read_back(read, folder_.path() / "onnx.h5");
  EXPECT_TRUE(describe(again, images) == describe(read, images));
  EXPECT_THAT(complaint(content, {}, file),
              AllOf(HasSubstr("its weights 'in.weight' are in another file, which is missing"),
                    HasSubstr((folder_.path() / "below/weights.bin").string())));
  EXPECT_TRUE(weight_files(folder_.path() / "none.onnx").empty());
  EXPECT_TRUE(weight_files(folder_.path()).empty());  // a folder: whoever reads it as a network says so
}

TEST_F(OnnxWeights, BesideTheFileMayLeaveOffsetAndLengthOut) {
  write(folder_.path() / "data", other::raw<float>({1, 2, 3, 4}));
  const auto tensor = [](const std::string& data) { return other::tensor("w", other::kFloat, {3}, data); };
  EXPECT_THAT(floats_of(3, tensor(other::in_file("data", "", "")), folder_.path() / "mine.onnx"),
              testing::ElementsAre(1, 2, 3));
  EXPECT_THAT(floats_of(3, tensor(other::in_file("data", "4", "")), folder_.path() / "mine.onnx"),
              testing::ElementsAre(2, 3, 4));
  EXPECT_THAT(floats_of(3, tensor(other::in_file("data", "4", "12")), folder_.path() / "mine.onnx"),
              testing::ElementsAre(2, 3, 4));
}

TEST_F(OnnxWeights, BesideTheFileMustBeThereAndInItsFolder) {
  write(folder_.path() / "data", std::string(16, '\0'));
  EXPECT_THAT(refused(other::in_file("data", "8", "12")),
              AllOf(HasSubstr("'w' are 12 bytes from byte 8 on of"), HasSubstr("which has 16 bytes")));
  EXPECT_THAT(refused(other::in_file("data", "5", "")), HasSubstr("12 bytes from byte 5 on"));
  EXPECT_THAT(refused(other::in_file("data", "18446744073709551615", "12")), HasSubstr("which has 16 bytes"));
  EXPECT_EQ(refused(other::in_file("data", "4", "12")), "accepted");
  EXPECT_THAT(refused(other::in_file("data", "0", "16")), HasSubstr("are 16 bytes of"));
  EXPECT_THAT(refused(other::in_file("data", "-1", "12")), HasSubstr("offset = '-1'; expected a number"));
  EXPECT_THAT(refused(other::in_file("data", "0", "1e3")), HasSubstr("length = '1e3'; expected a number"));
  EXPECT_THAT(refused(other::in_file("", "0", "12")),
              HasSubstr("expected a file in the network's own folder"));
  write(folder_.path() / "mine", "");
  const std::string absolute = folder_.path() / "data";
  for (const std::string& location : {absolute, "../" + folder_.path().filename().string() + "/data",
                                      std::string("a/../data"), std::string("data\0x", 6)})
    EXPECT_THAT(refused(other::in_file(location, "0", "12")),
                HasSubstr("expected a file in the network's own folder"));
  EXPECT_THAT(refused(other::in_file("no\nwhere", "0", "12")), HasSubstr("no?where"));
  fs::create_directories(folder_.path() / "folder");
  EXPECT_THAT(refused(other::in_file("folder", "0", "12")), HasSubstr("which has 0 bytes"));
}

TEST_F(OnnxWeights, AreAsManyAsTheirShapeSays) {
  EXPECT_EQ(refused(other::raw_data(std::string(12, 'x'))), "accepted");
  EXPECT_THAT(refused(other::raw_data(std::string(8, 'x'))),
              HasSubstr("'w' are 8 bytes; their shape and type need 12"));
  EXPECT_THAT(refused("", {3}), HasSubstr("'w' are 0 bytes"));
  EXPECT_THAT(refused(other::bytes(4, std::string(12, 'x'))), "accepted");  // float_data
  EXPECT_THAT(refused(other::bytes(4, std::string(16, 'x'))), HasSubstr("'w' are 16 bytes"));
  EXPECT_THAT(refused("", {1 << 20, 1 << 20}), HasSubstr("more than 2 GB"));
  EXPECT_THAT(refused("", {-1}), HasSubstr("more than 2 GB"));
  EXPECT_THAT(refused(other::in_file("data", "", ""), {1 << 30}), HasSubstr("more than 2 GB"));
  EXPECT_EQ(refused(other::raw_data(std::string(4, 'x')), {}), "accepted");  // a single number
  EXPECT_EQ(refused(other::raw_data(""), {0}), "accepted");
}

TEST_F(OnnxWeights, OfHalfPrecisionAndDoubleBecomeFloats) {
  for (int half = 0; half < 1 << 16; ++half) {
    const auto bits = static_cast<std::uint16_t>(half);
    const std::string raw = other::raw_data(other::raw<std::uint16_t>({bits}));
    const std::string typed = other::bytes(5, other::varint(bits));
    const float as_half = Eigen::half_impl::half_to_float(Eigen::half_impl::raw_uint16_to_half(bits));
    const float as_bfloat =
        Eigen::bfloat16_impl::bfloat16_to_float(Eigen::bfloat16_impl::raw_uint16_to_bfloat16(bits));
    if (half % 97 != 0 && half % 1024 != 0 && half > 1100) continue;  // all of the least ones
    for (const std::string& data : {raw, typed}) {
      const float h = floats_of(1, other::tensor("w", other::kFloat16, {1}, data)).at(0);
      const float b = floats_of(1, other::tensor("w", other::kBfloat16, {1}, data)).at(0);
      EXPECT_TRUE(h == as_half || (std::isnan(h) && std::isnan(as_half))) << half;
      EXPECT_TRUE(b == as_bfloat || (std::isnan(b) && std::isnan(as_bfloat))) << half;
    }
  }
  const std::vector<double> doubles{0.1, -3e-50, 1e30, 2};
  const std::string raw = other::raw(doubles);
  for (const std::string& data : {other::raw_data(raw), other::bytes(10, raw)})
    EXPECT_THAT(floats_of(4, other::tensor("w", other::kDouble, {4}, data)),
                testing::ElementsAre(0.1f, -0.f, 1e30f, 2.f));
}

TEST_F(OnnxWeights, AreLeftAsTheyAreWhereNothingIsToBeDone) {
  const std::string content = OtherAutoencoder(2).content({-1, 784});
  EXPECT_EQ(plain_weights(content, "mine.onnx"), content);
}

// As networks are exported in float16 or double throughout: inputs, outputs, weights, constants and casts.
TEST_F(OnnxWeights, OfWholeNetworksInOtherPrecisions) {
  const Rows& images = some_images();
  for (const int type : {other::kFloat16, other::kDouble}) {
    OtherAutoencoder network(3);
    const auto raw = [type](const Rows& m) {
      if (type == other::kDouble) {
        const std::vector<float> floats = numbers_of(m);
        return other::raw_data(other::raw(std::vector<double>(floats.begin(), floats.end())));
      }
      std::vector<std::uint16_t> halves;
      for (const float v : numbers_of(m)) halves.push_back(Eigen::half(v).x);
      return other::raw_data(other::raw(halves));
    };
    if (type == other::kFloat16)
      for (DenseLayer* layer : {&network.in, &network.code, &network.back, &network.out})
        for (Rows* m : {&layer->w, &layer->b}) *m = m->cast<Eigen::half>().cast<float>();
    network.written_by([&](const std::string& name, const std::vector<int>& dims, const Rows& m) {
      return other::tensor(name, type, dims, raw(m));
    });
    other::File file;
    file.input("image", {-1, 784}, type)
        .node("Cast", {"image"}, {"cast"}, other::integer_attribute("to", type))
        .node("Constant", {}, {"two"},
              other::tensor_attribute("value", other::tensor("two", type, {1}, raw(Rows::Constant(1, 1, 2)))))
        .node("Mul", {"cast", "two"}, {"flat"});
    network.encoder(file);
    network.decoder(file);
    const OnnxDescriptor read(file.content(), "mine.onnx");
    const Reconstructed found = reconstructed(read, images);
    const Rows z = network.position(2 * images);
    expect_near(found.position, z);
    expect_near(found.decoded, network.decoded(z));
  }
}

// OpenCV would not tell a cast to float16 from none, nor does any operator that it has take a list of
// tensors.
TEST_F(OnnxWeights, OfCastsAndOfListsOfTensors) {
  const std::vector<std::uint16_t> halves{Eigen::half(1.5f).x, Eigen::half(-2).x};
  const std::string list = other::bytes(
      5, other::bytes(1, "all") +
             other::bytes(10, other::tensor("w", other::kFloat16, {2}, other::raw_data(other::raw(halves)))));
  const OnnxModel model = parse_onnx(
      plain_weights(other::File()
                        .input("image", {-1, 784}, other::kFloat16)
                        .node("Cast", {"image"}, {"cast"}, other::integer_attribute("to", other::kFloat16))
                        .node("Any", {"cast"}, {"y"}, list)
                        .content(),
                    "mine.onnx"));
  EXPECT_THAT(model.nodes.at(0).bytes, HasSubstr(other::integer_attribute("to", other::kFloat)));
  EXPECT_THAT(model.nodes.at(1).bytes, HasSubstr(other::raw(std::vector<float>{1.5f, -2})));
}

TEST_F(OnnxWeights, ReadingSurvivesEveryShortening) {
  const std::string content = OtherAutoencoder(1).content({-1, 784});
  for (std::size_t size = 0; size < 400; ++size) {
    const std::string some = content.substr(0, size);
    EXPECT_THROW(parse_onnx(plain_weights(some, "mine.onnx")), InputError) << size;
  }
}

}  // namespace
}  // namespace hbr
