// The stages of the data and of the judge as programs, on a dataset made for it.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "pipeline/core/check.h"
#include "tests/models/dataset/idx_fixture.h"
#include "tests/support/shell.h"

namespace hbr {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;

class DataStages : public IdxFolder {
 protected:
  ShellResult run(const std::string& program, const json& settings, const json& inputs,
                  const std::string& output, int threads = 1) {
    const json slice = {{"stage", program},
                        {"name", program},
                        {"settings", settings},
                        {"inputs", inputs},
                        {"output", output}};
    const std::string text = slice.dump();
    write("slice.json", Bytes(text.begin(), text.end()));
    const std::string command = "cd " + folder_.string() + " && " HBR_BINARY_DIR "/bin/" + program +
                                " --root . --slice slice.json --output " + output +
                                " --checkpoint checkpoint --threads " + std::to_string(threads) + " 2>&1";
    return shell(command);
  }
  json dataset_settings() const {
    return {{"name", "made"}, {"folder", folder_.string()}, {"sha256", json::array()}};
  }
  static json judge_settings() {
    return {
        {"seed", 1},
        {"judge",
         {{"training_images", 30},
          {"bumps", 10},
          {"gamma", 0.2},
          {"ridge", 0.1},
          {"neighbours", 3},
          {"typical_share", 0.9}}},
        {"random_strokes",
         {{"images", 7}, {"fewest_points", 5}, {"most_points", 15}, {"thinnest_px", 1}, {"thickest_px", 4}}}};
  }
  void write_repertoire(const std::string& name, std::size_t n, std::size_t images) {
    Hdf5Writer file(folder_ / name);
    std::vector<std::int64_t> id(n);
    for (std::size_t i = 0; i < n; ++i) id[i] = static_cast<std::int64_t>(7 * i);
    file.write("id", id);
    file.write("image", {images, 28, 28}, train_.images.data());
    file.write("measures", {n, 2}, std::vector<float>(2 * n, 0.5f).data());
    file.write("objective", std::vector<float>(n, -0.03f));
    file.close();
  }
};

TEST_F(DataStages, JudgeTheImagesOfRepertoires) {
  ASSERT_EQ(run("dataset", dataset_settings(), json::object(), "dataset.h5").code, 0);
  ASSERT_EQ(run("judge", judge_settings(), {{"dataset", "dataset.h5"}}, "judge.h5").code, 0);
  const Hdf5Reader judge(folder_ / "judge.h5");
  for (const char* name : {"test_accuracy", "test_typical", "random_typical", "random_good"}) {
    EXPECT_GE(judge.number_attribute(name), 0) << name;
    EXPECT_LE(judge.number_attribute(name), 1) << name;
  }

  write_repertoire("hbr.h5", 12, 12);
  write_repertoire("flat.h5", 9, 9);
  const json inputs = {
      {"dataset", "dataset.h5"}, {"judge", "judge.h5"}, {"hbr", "hbr.h5"}, {"flat", "flat.h5"}};
  const ShellResult outcome = run("digit_verdicts", json::object(), inputs, "digits.h5");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const Hdf5Reader digits(folder_ / "digits.h5");
  EXPECT_EQ(digits.read<std::int64_t>("flat/id").values,
            Hdf5Reader(folder_ / "flat.h5").read<std::int64_t>("id").values);
  const auto image = digits.read<std::uint8_t>("flat/image");
  EXPECT_EQ(image.shape, (std::vector<std::size_t>{9, 28, 28}));
  EXPECT_TRUE(std::equal(image.values.begin(), image.values.end(), train_.images.begin()));
  EXPECT_EQ(digits.read<float>("hbr/measures").shape, (std::vector<std::size_t>{12, 2}));
  EXPECT_EQ(digits.read<float>("hbr/objective").values, std::vector<float>(12, -0.03f));
  EXPECT_EQ(digits.read<float>("hbr/distance").values,
            std::vector<float>(12, 0));  // they are training images
  EXPECT_EQ(digits.read<std::uint8_t>("hbr/label").values.size(), 12u);
  EXPECT_EQ(digits.read<float>("hbr/confidence").values.size(), 12u);
  EXPECT_EQ(digits.read<std::uint8_t>("hbr/good").values.size(), 12u);
}

TEST_F(DataStages, LeaveTheSameBytesForOneThreadAndTwo) {
  for (const int threads : {1, 2}) {
    const std::string n = std::to_string(threads);
    ASSERT_EQ(run("dataset", dataset_settings(), json::object(), "dataset" + n + ".h5", threads).code, 0);
    ASSERT_EQ(
        run("judge", judge_settings(), {{"dataset", "dataset" + n + ".h5"}}, "judge" + n + ".h5", threads)
            .code,
        0);
  }
  EXPECT_EQ(read("dataset1.h5"), read("dataset2.h5"));
  EXPECT_EQ(read("judge1.h5"), read("judge2.h5"));
}

TEST_F(DataStages, SayInOneLineWhatIsWrong) {
  std::filesystem::remove(folder_ / kIdxFiles[0]);
  ShellResult outcome = run("dataset", dataset_settings(), json::object(), "dataset.h5");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.text, HasSubstr(kIdxFiles[0]));
  EXPECT_EQ(std::count(outcome.text.begin(), outcome.text.end(), '\n'), 1) << outcome.text;

  write_part(0, train_);
  // Another dataset in MNIST's place.
  json mnist = dataset_settings();
  mnist["sha256"] = {"a", "b", "c", "d"};
  outcome = run("dataset", mnist, json::object(), "dataset.h5");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("under [dataset] its name, its folder, and sha256 = []"));

  ASSERT_EQ(run("dataset", dataset_settings(), json::object(), "dataset.h5").code, 0);
  json settings = judge_settings();
  settings["random_strokes"]["fewest_points"] = 20;
  outcome = run("judge", settings, {{"dataset", "dataset.h5"}}, "judge.h5");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("random_strokes"));

  ASSERT_EQ(run("judge", judge_settings(), {{"dataset", "dataset.h5"}}, "judge.h5").code, 0);
  write_repertoire("hbr.h5", 12, 11);
  const json inputs = {
      {"dataset", "dataset.h5"}, {"judge", "judge.h5"}, {"hbr", "hbr.h5"}, {"flat", "hbr.h5"}};
  outcome = run("digit_verdicts", json::object(), inputs, "digits.h5");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("hbr.h5"));
}

}  // namespace
}  // namespace hbr
