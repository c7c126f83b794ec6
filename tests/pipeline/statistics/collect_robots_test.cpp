// What is told of other robots.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "pipeline/statistics/collect.h"
#include "pipeline/statistics/names.h"
#include "pipeline/statistics/summary.h"
#include "tests/support/synthetic_experiment.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using nlohmann::json;

TEST(CollectRobots, ProjectionBeforeAndAfter) {
  TemporaryFolder folder;
  SyntheticExperiment experiment(folder.path(), 2);
  experiment.projection("nao");
  const json found = collect_statistics("projected", experiment.artifacts())["quantities"];
  for (const auto& [name, value] : {std::pair{"within_before", .7},
                                    {"within_after", .9},
                                    {"nearest_before", .5},
                                    {"nearest_after", .5},
                                    {"off_plane_before", .8},
                                    {"off_plane_after", 1e-4},
                                    {"distance_before", 1.6},
                                    {"distance_after", 2e-4},
                                    {"variance_before", .35},
                                    {"variance_after", .35},
                                    {"added", 1.}}) {
    const json& quantity = found.at(std::string("projected.nao.") + name);
    EXPECT_EQ(quantity["n"], 2) << name;
    EXPECT_NEAR(quantity["median"].get<double>(), value, 1e-6) << name;
  }
}

TEST(CollectRobots, TransferWithoutItsOutliers) {
  TemporaryFolder folder;
  SyntheticExperiment experiment(folder.path(), 2);
  experiment.transfer("nao", 100);
  const json found = collect_statistics("tiny", experiment.artifacts());
  const auto number = [&](const std::string& name) {
    return found["numbers"]["transfer.nao." + name]["value"].get<double>();
  };
  EXPECT_EQ(number("images"), 200);
  EXPECT_DOUBLE_EQ(number("absolute_outliers"), 100 * 4.0 / 200);
  EXPECT_NEAR(number("absolute_median"), 0.92, 0.1);
  EXPECT_LT(number("absolute_high"), 2);
  EXPECT_NEAR(number("evolved_absolute_median"), 1.5 * number("absolute_median"), 1e-5);
  EXPECT_NEAR(number("squared_high"), number("absolute_high") / 3, 1e-6);
  EXPECT_EQ(found["quantities"]["transfer.nao.lost"]["values"], (json{10.0, 10.0}));
  EXPECT_EQ(found["quantities"]["transfer.nao.evolved_lost"]["values"], (json{20.0, 20.0}));
  EXPECT_EQ(found["quantities"]["transfer.nao.absolute"]["unit"], "%");
  EXPECT_FLOAT_EQ(found["boxes"]["transfer.nao.absolute"]["max"].get<float>(), 8.0f);
  EXPECT_EQ(found["boxes"]["transfer.nao.arc_centre"]["n"], 400);
  EXPECT_EQ(found["quantities"]["transfer.nao.line_end"]["unit"], "m");
  const auto ends = Hdf5Reader(folder.path() / "nao_transfer/01.h5").read<float>("lines/end").values;
  EXPECT_EQ(found["quantities"]["transfer.nao.line_end"]["values"][1],
            summarise({ends.begin(), ends.end()}, "ends").median);
}

TEST(CollectRobots, TransferCountsOutliersAboveOnly) {
  TemporaryFolder folder;
  const std::filesystem::path path = folder.path() / "t.h5";
  Hdf5Writer file(path);
  for (const char* name : {"absolute", "squared", "evolved/absolute", "evolved/squared"})
    file.write(name, std::vector<float>{0, 1, 1.01f, 1.02f, 1.03f, 1.04f, 1.05f, 5});
  for (const char* name : {"lines/end", "lines/displacement", "arcs/end", "arcs/centre", "arcs/length"})
    file.write(name, std::vector<float>{1});
  for (const char* name : {"good", "lost", "evolved/lost"}) file.write(name, std::vector<std::uint8_t>(8, 0));
  file.close();
  const json all = collect_statistics("tiny", {{"nao_transfer/00.h5", path}}), &found = all["numbers"];
  EXPECT_FALSE(all["quantities"].contains("transfer.nao.lost"));  // there is no good digit to lose
  EXPECT_EQ(found["transfer.nao.absolute_outliers"]["value"], 12.5);
  EXPECT_NEAR(found["transfer.nao.absolute_low"]["value"].get<double>(), 100, 1e-4);
}

TEST(CollectRobots, DynamicsOfDigitsAndJoints) {
  TemporaryFolder folder;
  SyntheticExperiment experiment(folder.path(), 2);
  experiment.dynamics("nao", 9);
  const json found = collect_statistics("tiny", experiment.artifacts());
  EXPECT_EQ(found["numbers"]["dynamics.nao.digits"]["value"], 18);
  EXPECT_NEAR(found["boxes"]["dynamics.nao.arm_rms"]["median"].get<double>(), 0.06, 0.012);
  EXPECT_NEAR(found["boxes"]["dynamics.nao.whole_margin"]["median"].get<double>(), 20, 4);  // mm
  EXPECT_EQ(found["quantities"]["dynamics.nao.whole_tips"]["values"][0], 100 * 3.0 / 9);
  EXPECT_FALSE(found["boxes"].contains("dynamics.nao.arm_margin"));
  // The second joint always bears the most.
  for (const char* statistic : {"min", "median", "max"}) {
    const auto of = [&](const char* name) { return found["boxes"][name][statistic].get<double>(); };
    EXPECT_DOUBLE_EQ(of("dynamics.nao.whole_torque"), of("dynamics.nao.whole_torque_of.Elbow"));
    EXPECT_FLOAT_EQ(static_cast<float>(of("dynamics.nao.arm_speed_of.Elbow")),
                    static_cast<float>(2 * of("dynamics.nao.arm_speed_of.Shoulder")));
  }
}

// Dots separate the words of a statistic's name.
TEST(CollectRobots, JointsMayHaveBlanksAndDotsInTheirNames) {
  TemporaryFolder folder;
  SyntheticExperiment experiment(folder.path(), 2);
  experiment.dynamics("nao", 9, {"joint 1", "a.b", "a_b"});
  const json boxes = collect_statistics("tiny", experiment.artifacts())["boxes"];
  for (const std::string name : {"arm_torque", "whole_speed"}) {
    const auto median = [&](const std::string& joint) {
      return boxes.at("dynamics.nao." + name + "_of." + joint)["median"].get<double>();
    };
    EXPECT_NEAR(median("a_b_2"), 2 * median("joint_1"), 1e-4);
    EXPECT_NEAR(median("a_b"), 3 * median("joint_1"), 1e-4);
    EXPECT_EQ(boxes.at("dynamics.nao." + name)["median"], median("a_b"));
  }
}

TEST(CollectRobots, TunedLayersAreComparedWithThoseBeforeAndWithTheControl) {
  TemporaryFolder folder;
  SyntheticExperiment experiment(folder.path(), 3);
  experiment.tuned("nao", 200);
  experiment.tuned("arm", 200);
  const json found = collect_statistics("tiny", experiment.artifacts()), &quantities = found["quantities"],
             &tests = found["tests"], &boxes = found["boxes"];
  const auto value = [&](const std::string& name, std::size_t r) {
    return quantities["tuned." + name]["values"][r].get<double>();
  };
  for (std::size_t r = 0; r < 3; ++r) {
    const Hdf5Reader file(folder.path() / fmt::format("nao_tuned/0{}.h5", r));
    const auto share = [&](const std::string& state) {
      const auto good = file.read<std::uint8_t>(state + "/good").values;
      return static_cast<double>(std::accumulate(good.begin(), good.end(), 0)) / 200;
    };
    const auto mean_of = [&](const std::string& state) {
      double sum = 0;
      for (const float fitness : file.read<float>(state + "/objective").values)
        sum += static_cast<double>(fitness);
      return sum / 200;
    };
    for (const std::string state : {"top", "all"}) {
      EXPECT_NEAR(value("nao." + state + ".mean", r), mean_of(state), 1e-12);
      EXPECT_NEAR(value("nao." + state + ".gain", r), mean_of(state) - mean_of("before"), 1e-12);
      EXPECT_NEAR(value("nao." + state + ".good_gain", r), share(state) - share("before"), 1e-12);
    }
    const auto line = file.read<float>("all/line_from_arm").values;
    EXPECT_EQ(value("nao.all.line_from_arm", r), summarise({line.begin(), line.end()}, "line").median);
  }
  EXPECT_EQ(quantities["tuned.nao.before.size"]["values"], (std::vector<double>{200, 200, 200}));
  EXPECT_EQ(boxes["tuned.nao.all.difference"]["n"], 600);
  EXPECT_NEAR(boxes["tuned.nao.all.difference"]["max"].get<double>(), 2.8, 0.1);  // per cent
  EXPECT_EQ(boxes["tuned.nao.before.arc_length"]["n"], 600);
  EXPECT_FALSE(boxes.contains("tuned.nao.top.line"));
  EXPECT_EQ(tests["tuned.nao.all.mean_vs_tuned.nao.before.mean"]["a12"], 1);
  EXPECT_EQ(tests["tuned.arm.top.gain_vs_tuned.nao.top.gain"]["a12"], 0);  // the robot gains more
  EXPECT_TRUE(tests.contains("tuned.nao.all.line_vs_tuned.nao.before.line"));
  EXPECT_FALSE(tests.contains("tuned.arm.top.mean_vs_tuned.nao.top.mean"));
  EXPECT_FALSE(tests.contains("tuned.arm.all.gain_vs_tuned.nao.top.gain"));
  for (const char* none : {"tuned.nao.before.gain", "tuned.nao.top.line", "tuned.nao.after.mean"})
    EXPECT_FALSE(meaning_of(none)) << none;
}

}  // namespace
}  // namespace hbr
