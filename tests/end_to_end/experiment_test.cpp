// The experiment itself, tiny: all its stages, through the tool and a real make.
#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/drawing/draw.h"
#include "tests/end_to_end/expect_explorer.h"
#include "tests/end_to_end/expect_format.h"
#include "tests/end_to_end/expect_robots.h"
#include "tests/end_to_end/expect_shape.h"
#include "tests/end_to_end/tiny_experiment.h"

namespace hbr {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

// The strokes' pen is where the joints put it, and draws the image of its elite once more. Returns which.
std::vector<std::int64_t> expect_strokes_draw_the_images(const fs::path& out, const fs::path& path) {
  const Hdf5Reader strokes(path), layer4(out / "layer4/00.h5");
  const Elites digits = read_elites(out / "layer4/00.h5");
  const auto images = layer4.read<std::uint8_t>("image").values;
  const auto label = strokes.read<std::uint8_t>("label").values;
  const auto id = strokes.read<std::int64_t>("id").values;
  const auto points = strokes.read<std::int32_t>("points").values;
  const auto pen = strokes.read<float>("pen").values, joints = strokes.read<float>("joints").values,
             links = strokes.read<float>("links").values;
  EXPECT_FALSE(id.empty());
  EXPECT_TRUE(std::ranges::is_sorted(label));
  std::size_t at = 0;
  for (std::size_t i = 0; i < id.size(); ++i) {
    const auto row = std::ranges::find(digits.id, id[i]) - digits.id.begin();
    const double width = 1 + 3 * digits.solution(row, 2);
    std::vector<float> image(kImagePixels);
    draw(&pen[2 * at], points[i], width, Framing::box, 0.63965, image.data());
    std::vector<std::uint8_t> bytes(kImagePixels);
    image_to_bytes(image.data(), bytes.data());
    EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), images.begin() + row * kImagePixels)) << i;
    for (std::int32_t k = 0; k < points[i]; ++k, ++at) {
      double x = 0, y = 0, angle = 0;
      for (std::size_t link = 0; link < links.size(); ++link) {
        angle += joints[at * links.size() + link];
        x += links[link] * std::cos(angle);
        y += links[link] * std::sin(angle);
      }
      EXPECT_NEAR(pen[2 * at], x, 1e-5) << i;
      EXPECT_NEAR(pen[2 * at + 1], y, 1e-5) << i;
    }
  }
  EXPECT_EQ(2 * at, pen.size());
  return id;
}

// Verdicts made up so that the digits to be drawn are known, and are not the first ones.
void expect_strokes_of_the_surest(const fs::path& out) {
  const Elites digits = read_elites(out / "layer4/00.h5");
  const auto n = static_cast<std::size_t>(digits.size());
  ASSERT_GE(n, 5u);
  std::vector<std::uint8_t> label(n, 7), good(n, 0);
  std::vector<float> confidence(n, 0.1f);
  confidence[1] = 0.8f;                                         // the surest 7, none of which is good
  label[n - 1] = 2, good[n - 1] = 1, confidence[n - 1] = 0.3f;  // a good 2 comes before surer ones
  label[n - 2] = 2, confidence[n - 2] = 0.9f;
  Hdf5Writer verdicts(out / "made_up.h5");
  verdicts.write("hbr/id", digits.id);
  verdicts.write("hbr/label", label);
  verdicts.write("hbr/good", good);
  verdicts.write("hbr/confidence", confidence);
  verdicts.close();

  const json settings = json::parse(Hdf5Reader(out / "surest_digits/00.h5").text_attribute("settings"));
  std::ofstream(out / "made_up.json") << json{{"stage", "surest_digits"},
                                              {"name", "surest_digits/00"},
                                              {"settings", settings},
                                              {"inputs",
                                               {{"layer1", "layer1/00.h5"},
                                                {"layer2", "layer2_n10/00.h5"},
                                                {"layer3", "layer3_b/00.h5"},
                                                {"layer4", "layer4/00.h5"},
                                                {"digits", "made_up.h5"}}},
                                              {"output", "drawn.h5"}};
  const ShellResult outcome = shell(
      "cd " + out.string() +
      " && " HBR_BINARY_DIR
      "/bin/surest_digits --root . --slice made_up.json --output drawn.h5 --checkpoint none --threads 1");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(expect_strokes_draw_the_images(out, out / "drawn.h5"),
              ElementsAre(digits.id[n - 1], digits.id[1]));
  for (const char* made_up : {"made_up.h5", "made_up.json", "drawn.h5"}) fs::remove(out / made_up);
}

// A run in Python: by h5py alone, as exported for other libraries, and by the lines of the README.
void expect_python_reads(const fs::path& out) {
  const std::string bin = HBR_BINARY_DIR "/bin/", exported = (out / "export").string();
  const std::string tool = bin + "export_repertoires " + out.string() + " ";
  for (const char* format : {"pyribs", "qdax"}) {
    const ShellResult outcome = shell(tool + format + " " + exported);
    ASSERT_EQ(outcome.code, 0) << outcome.text;
  }
  const ShellResult read =
      shell("/usr/bin/python3 " HBR_SOURCE_DIR "/tests/python/read_run.py " + out.string() + " " + exported);
  EXPECT_EQ(read.code, 0) << read.text;
  const auto files = [&](const std::string& words) {
    const fs::path to = out / "some";
    EXPECT_EQ(shell(tool + "pyribs " + to.string() + " " + words).code, 0);
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(to))
      if (entry.is_regular_file()) names.insert(entry.path().lexically_relative(to / "pyribs").string());
    fs::remove_all(to);
    return names;
  };
  // A file of somebody else's is no artifact.
  std::ofstream(out / "layer4/mine.h5") << "mine";
  EXPECT_THAT(files("layer4"), ElementsAre("layer4/00.csv"));
  fs::remove(out / "layer4/mine.h5");
  EXPECT_THAT(files("layer2 0"), ElementsAre("layer2_n1/00.csv", "layer2_n10/00.csv", "layer2_n100/00.csv",
                                             "layer2_n10_short/00.csv"));
  for (const auto& [words, why] : {std::pair{"csv to", "FORMAT 'csv': expected pyribs"},
                                   std::pair{"\"\" to", "FORMAT '': expected pyribs"},
                                   std::pair{"qdax to layr4", "STAGE 'layr4': no repertoires of it"},
                                   std::pair{"qdax to layer4 7", "REP 07: no repertoire"},
                                   std::pair{"qdax to layer4 x", "REP 'x': expected the number"}}) {
    const ShellResult refused = shell("cd " + out.string() + " && " + tool + words);
    EXPECT_EQ(refused.code, 2) << words;
    EXPECT_THAT(refused.text, HasSubstr(why));
    EXPECT_FALSE(fs::exists(out / "to"));
  }

  const fs::path place = out / "python";
  fs::create_directories(place / "out");
  fs::create_directory_symlink(out, place / "out/reduced");
  const std::string readme = read_whole(HBR_SOURCE_DIR "/README.md"), opening = "```python\n";
  const std::size_t begin = readme.find(opening) + opening.size();
  std::ofstream(place / "example.py") << readme.substr(begin, readme.find("```", begin) - begin);
  const ShellResult printed = shell("cd " + place.string() + " && /usr/bin/python3 example.py");
  EXPECT_EQ(printed.code, 0) << printed.text;
  const Elites digits = read_elites(out / "layer4/00.h5");
  Eigen::Index best = 0;
  digits.objective.maxCoeff(&best);
  EXPECT_THAT(printed.text, HasSubstr(fmt::format("digit {} ", digits.id[best])));
  EXPECT_THAT(printed.text, HasSubstr("pen width"));
  EXPECT_THAT(printed.text, HasSubstr("#"));
  for (const char* made : {"export", "python"}) fs::remove_all(out / made);
}

// One test, since all begins with the whole experiment.
TEST(Experiment, IsMadeOnceAndAgainOnlyWhereSomethingChanged) {
  TinyExperiment experiment;
  const ShellResult first = experiment.make("one", 1), second = experiment.make("two", 2);
  ASSERT_EQ(first.code, 0) << first.text;
  ASSERT_EQ(second.code, 0) << second.text;
  const auto artifacts = experiment.artifacts("one"), others = experiment.artifacts("two");
  EXPECT_GT(artifacts.size(), 28u);
  ASSERT_EQ(artifacts.size(), others.size());
  for (const auto& [name, bytes] : artifacts) {
    ASSERT_TRUE(others.contains(name)) << name;
    EXPECT_TRUE(others.at(name) == bytes) << name << " differs between one thread and two";
  }

  expect_strokes_draw_the_images(experiment.out("one"), experiment.out("one/surest_digits/00.h5"));
  expect_strokes_of_the_surest(experiment.out("one"));
  DescribedFormat().expect(experiment.out("one"));
  ExpectedExplorer explorer(experiment.out("one"));
  explorer.expect();
  expect_python_reads(experiment.out("one"));
  const RobotArtifacts robots(experiment.out("one"));
  for (const char* robot : {"nao", "industrial"}) {
    SCOPED_TRACE(robot);
    robots.expect_points(robot);
    robots.expect_transfer(robot);
    robots.expect_dynamics(robot);
    robots.expect_tuned(robot);
  }
  robots.expect_tuned("arm");
  expect_robot_shape(experiment.out("one"), "nao", 0.0015);
  expect_robot_shape(experiment.out("one"), "industrial", 0.005);
  expect_arm_shape(experiment.out("one"));

  // The page says what was found: its templates' fields are filled, no number is undefined.
  const std::string publish = HBR_BINARY_DIR "/bin/publish " + experiment.out("one/page").string() + " " +
                              experiment.out("one").string() + " " + experiment.out("report").string();
  const ShellResult published = shell(publish);
  ASSERT_EQ(published.code, 0) << published.text;
  const std::string page = read(experiment.out("report/index.html"));
  EXPECT_THAT(page, HasSubstr("profile tiny"));
  EXPECT_THAT(page, HasSubstr("</html>"));
  for (const char* unwanted : {"{{", "}}", ">nan<", ">-nan<", ">inf<", ">-inf<"})
    EXPECT_THAT(page, Not(HasSubstr(unwanted)));
  explorer.expect_page(page);
#ifdef NDEBUG  // under sanitizers the page is the same, and the browser is not ours
  const ShellResult browser =
      shell("RUN=" + experiment.out("one").string() + " node " HBR_SOURCE_DIR "/tests/browser/run.mjs " +
            experiment.out("report/index.html").string());
  EXPECT_EQ(browser.code, 0) << browser.text;
#endif

  // A damaged artifact comes back, and what depends on it stays.
  std::ofstream(experiment.out("one/layer2_n10/00.h5"), std::ios::app) << "x";
  EXPECT_EQ(made(experiment.make("one", 1)), "layer2_n10/00");
  EXPECT_TRUE(experiment.artifacts("one") == artifacts);

  experiment.profile.set("layers.layer3_n1", "samples", "2");
  EXPECT_EQ(made(experiment.make("one", 1)), "arc_quality/00 layer3_n1/00 page statistics.json");

  experiment.profile.set("replications", "lines", "2");
  const std::vector<std::string> more = words(made(experiment.make("one", 1)));
  for (const std::string& name : more)
    EXPECT_TRUE(name.ends_with("/01") || name == "page" || name == "statistics.json") << name;
  EXPECT_EQ(more.size(), 17u);  // 15 stages of a replication of lines
  EXPECT_EQ(made(experiment.make("one", 1)), "");
}

}  // namespace
}  // namespace hbr
