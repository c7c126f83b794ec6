#include "pipeline/artifact/stage.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

struct Points {
  int count = 0;
};
template <class Fields>
void describe(Fields& f, Points& s) {
  f.number("count", s.count, Range{1, 100}, "points to draw");
}

class Stage : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::path(testing::TempDir()) /
              (std::string("stage_") + testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_ / "layer1");
    std::ofstream(folder_ / "layer1/00.h5") << "points";
  }
  void TearDown() override { fs::remove_all(folder_); }
  void slice(const std::string& text) { std::ofstream(folder_ / "slice.json") << text; }
  void good_slice(int count) {
    slice(R"({"stage": "lines", "name": "lines/00", "settings": {"count": )" + std::to_string(count) +
          R"(}, "inputs": {"points": "layer1/00.h5", "lost": "layer1/01.h5"}, "output": "lines/00.h5"})");
  }
  // Exit code and what stood on stderr.
  std::pair<int, std::string> main(const std::function<void(StageRun&)>& run) {
    std::vector<std::string> words{"/bin/lines",
                                   "--root",
                                   folder_.string(),
                                   "--slice",
                                   (folder_ / "slice.json").string(),
                                   "--output",
                                   (folder_ / "out.tmp").string(),
                                   "--checkpoint",
                                   (folder_ / "check").string(),
                                   "--threads",
                                   "3"};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    testing::internal::CaptureStderr();
    const int code = stage_main(static_cast<int>(words.size()), argv.data(), "Lines", run);
    return {code, testing::internal::GetCapturedStderr()};
  }
  fs::path folder_;
};

TEST_F(Stage, HandsOverSettingsInputsAndPlaces) {
  good_slice(7);
  const auto [code, text] = main([&](StageRun& stage) {
    EXPECT_EQ(stage.stage(), "lines");
    EXPECT_EQ(stage.name(), "lines/00");
    EXPECT_EQ(stage.settings_as<Points>().count, 7);
    EXPECT_EQ(stage.settings().dump(), R"({"count":7})");
    EXPECT_EQ(stage.input("points"), folder_ / "layer1/00.h5");
    EXPECT_THAT(stage.inputs(), ElementsAre("lost", "points"));
    EXPECT_TRUE(stage.has_input("lost"));
    EXPECT_FALSE(stage.has_input("arcs"));
    EXPECT_EQ(stage.output(), folder_ / "out.tmp");
    EXPECT_EQ(stage.checkpoint(), folder_ / "check");
    EXPECT_EQ(stage.threads(), 3);
    stage.progress(1, 2, "points");
  });
  EXPECT_EQ(code, 0);
  EXPECT_EQ(text, "");
}

TEST_F(Stage, FailuresAreOneLineAndACode) {
  const auto nothing = [](StageRun&) {};
  good_slice(0);
  EXPECT_EQ(main([](StageRun& stage) { stage.settings_as<Points>(); }),
            std::pair(2, "lines/00: " + (folder_ / "slice.json").string() +
                             ": count: expected a whole number from 1 to 100 (points to draw), found 0\n"));
  EXPECT_THAT(main([](StageRun& stage) { stage.input("lost"); }).second,
              testing::AllOf(HasSubstr("layer1/01.h5: missing"), HasSubstr("give the same make again")));
  EXPECT_THAT(main([](StageRun& stage) { stage.input("point"); }).second,
              HasSubstr("(did you mean 'points'?)"));
  EXPECT_EQ(main([](StageRun&) { throw std::runtime_error("two\nlines"); }),
            std::pair(3, std::string("lines/00: unexpected error: two lines\n")));
  slice("{");
  EXPECT_EQ(main(nothing).first, 2);
  slice("{}");
  EXPECT_THAT(main(nothing).second, HasSubstr("slice.json: missing key 'stage'"));
  fs::remove(folder_ / "slice.json");
  EXPECT_THAT(main(nothing).second, HasSubstr("slice.json: can't read: No such file"));
}

TEST(StageCommandLine, AsksForWhatIsMissing) {
  std::string program = "lines";
  char* argv[] = {program.data(), nullptr};
  testing::internal::CaptureStderr();
  EXPECT_NE(stage_main(1, argv, "Lines", [](StageRun&) { FAIL(); }), 0);
  EXPECT_THAT(testing::internal::GetCapturedStderr(), HasSubstr("--root is required"));
}

TEST_F(Stage, SettingsBecomeAttributes) {
  slice(R"({"stage": "lines", "name": "lines/00", "inputs": {}, "output": "lines/00.h5", "settings":
            {"seed": 7, "archive": {"spacing": 0.25, "selector": "uniform"}, "links": [1.5, 2], "flat": true,
             "words": ["a", "b"], "tables": [{"x": 1}], "none": []}})");
  const auto [code, text] = main([](StageRun& stage) {
    Hdf5Writer file(stage.output());
    stage.write_settings(file);
    file.close();
  });
  ASSERT_EQ(code, 0) << text;
  const Hdf5Reader file(folder_ / "out.tmp");
  EXPECT_EQ(file.text_attribute("stage"), "lines");
  EXPECT_EQ(file.number_attribute("settings.seed"), 7);
  EXPECT_EQ(file.number_attribute("settings.archive.spacing"), 0.25);
  EXPECT_EQ(file.text_attribute("settings.archive.selector"), "uniform");
  // Lists of numbers or of words are arrays, whose values tests/python reads.
  for (const char* list : {"settings.links", "settings.words", "settings.none"}) {
    EXPECT_TRUE(file.has_attribute(list));
    EXPECT_THROW(file.number_attribute(list), InputError) << list;
    EXPECT_THROW(file.text_attribute(list), InputError) << list;
  }
  EXPECT_EQ(file.text_attribute("settings.tables"), R"([{"x":1}])");
  EXPECT_EQ(file.number_attribute("settings.flat"), 1);
  EXPECT_EQ(nlohmann::json::parse(file.text_attribute("settings")).at("archive").at("spacing"), 0.25);
}

}  // namespace
}  // namespace hbr
