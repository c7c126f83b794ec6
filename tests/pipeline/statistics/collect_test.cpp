#include "pipeline/statistics/collect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <numeric>
#include <set>

#include "pipeline/core/check.h"
#include "pipeline/statistics/names.h"
#include "pipeline/statistics/rank_correlation.h"
#include "pipeline/statistics/summary.h"
#include "tests/support/synthetic_experiment.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using nlohmann::json;

const std::string kSample = std::string(HBR_SOURCE_DIR) + "/tests/reports/fixtures/statistics.json";

// The sample that the report's tests read is what this code makes. HBR_UPDATE_FIXTURES=1 writes it anew.
TEST(Collect, SampleOfTheReportIsUpToDate) {
  TemporaryFolder folder;
  SyntheticExperiment experiment(folder.path(), 3);
  experiment.everything(20);
  const json found = collect_statistics("reduced", experiment.artifacts());
  if (std::getenv("HBR_UPDATE_FIXTURES")) std::ofstream(kSample) << found.dump(1) << '\n';
  const json expected = json::parse(std::ifstream(kSample)).flatten(), flat = found.flatten();
  ASSERT_EQ(expected.size(), flat.size());
  for (const auto& [key, value] : expected.items()) {
    ASSERT_TRUE(flat.contains(key)) << key;
    if (value.is_number())
      EXPECT_NEAR(value.get<double>(), flat[key].get<double>(), 1e-9 * std::abs(value.get<double>())) << key;
    else
      EXPECT_EQ(value, flat[key]) << key;
  }
  EXPECT_EQ(found.dump(), collect_statistics("reduced", experiment.artifacts()).dump());
  for (const char* section : {"quantities", "numbers", "boxes"})
    for (const auto& [name, value] : found[section].items()) EXPECT_TRUE(meaning_of(name)) << name;
}

TEST(Collect, NothingComesOfNothing) {
  const json found = collect_statistics("empty", {});
  for (const char* section : {"quantities", "numbers", "tests", "boxes", "curves"})
    EXPECT_EQ(found[section], json::object()) << section;
}

TEST(Collect, SearchesBySizeBestAndMean) {
  TemporaryFolder folder;
  SyntheticExperiment experiment(folder.path(), 2);
  experiment.search("layer2_n10", 40, 2, -0.1, -0.5, 100);
  const json found = collect_statistics("tiny", experiment.artifacts());
  for (int r = 0; r < 2; ++r) {
    const Elites elites = read_elites(folder.path() / fmt::format("layer2_n10/{:02}.h5", r));
    const auto values = [&](const char* name) {
      return found["quantities"][std::string("layer2.n10.") + name]["values"][static_cast<std::size_t>(r)]
          .get<double>();
    };
    EXPECT_EQ(values("size"), static_cast<double>(elites.size()));
    EXPECT_FLOAT_EQ(static_cast<float>(values("best")), elites.objective.maxCoeff());
    EXPECT_FLOAT_EQ(static_cast<float>(values("mean")), elites.objective.mean());
    EXPECT_EQ(values("evaluations"), 20000);
  }
  EXPECT_EQ(found["numbers"]["layer2.n10.generations"]["value"], 100);
  EXPECT_EQ(found["numbers"]["layer2.n10.genes"]["value"], 2);
  EXPECT_EQ(found["curves"]["layer2.n10"]["at"].size(), 21u);
}

TEST(Collect, MediansOfAccuracyAndSubstitution) {
  TemporaryFolder folder;
  std::filesystem::create_directories(folder.path() / "accuracy");
  Hdf5Writer accuracy(folder.path() / "accuracy/00.h5");
  accuracy.write("layer2_n10/squared_error", std::vector<float>{4, 1, 2});
  accuracy.write("reference_endpoint/squared_error", std::vector<float>{8, 6, 4});
  accuracy.close();
  Hdf5Writer substitution(folder.path() / "s.h5");
  substitution.write("original", Array<float>{{2, 3}, {1, 2, 3, 3, 4, 5}});
  substitution.write("substitute", Array<float>{{1, 3}, {7, 8, 9}});
  substitution.close();
  const json found = collect_statistics("tiny", {{"accuracy/00.h5", folder.path() / "accuracy/00.h5"},
                                                 {"substitution/04.h5", folder.path() / "s.h5"}});
  EXPECT_EQ(found["quantities"]["accuracy.n10"]["values"], (std::vector<double>{2}));
  EXPECT_EQ(found["quantities"]["substitution.m2.original"]["median"], 3);
  EXPECT_EQ(found["quantities"]["substitution.m2.original"]["replications"], (std::vector<int>{4}));
  EXPECT_EQ(found["quantities"]["substitution.m3.substitute"]["median"], 9);
  EXPECT_EQ(found["boxes"]["substitution.m1.original"]["n"], 2);
  EXPECT_EQ(found["numbers"]["accuracy.requests"]["value"], 3);
  std::vector<std::string> tests;
  for (const auto& [name, test] : found["tests"].items()) tests.push_back(name);
  EXPECT_THAT(tests, testing::ElementsAre("accuracy.n10_vs_accuracy.reference_endpoint",
                                          "substitution.m1.original_vs_substitution.m1.substitute",
                                          "substitution.m2.original_vs_substitution.m2.substitute",
                                          "substitution.m3.original_vs_substitution.m3.substitute"));
}

TEST(Collect, SearchesOnACommonGrid) {
  TemporaryFolder folder;
  SyntheticExperiment experiment(folder.path(), 3);
  experiment.searches({"curiosity", "local_curiosity"}, 100);
  const json found = collect_statistics("tiny", experiment.artifacts());
  const Hdf5Reader file(folder.path() / "searches.h5");
  for (const std::string search : {"curiosity", "local_curiosity"}) {
    for (const std::string measure : {"coverage", "qd_score", "cell_mean"}) {
      const json& quantity = found["quantities"]["layer1_search." + search + "." + measure];
      EXPECT_EQ(quantity["values"], file.read<double>(search + "/" + measure).values) << search << measure;
      EXPECT_EQ(quantity["replications"], (std::vector<int>{0, 1, 2}));
    }
    EXPECT_EQ(found["quantities"]["layer1_search." + search + ".size"]["n"], 3);
  }
  EXPECT_EQ(found["numbers"]["searches.filled_by_any"]["value"], 1600);
  EXPECT_TRUE(found["tests"].contains("layer1_search.curiosity.mean_vs_layer1_search.local_curiosity.mean"));
  EXPECT_FALSE(meaning_of("layer1.coverage"));
}

// Measures of the drawings against their definitions, pair by pair.
TEST(Collect, DigitsAgainstTheirDefinitions) {
  TemporaryFolder folder;
  SyntheticExperiment experiment(folder.path(), 1);
  experiment.digits(60, 0.5, 0.3);
  const json found = collect_statistics("tiny", experiment.artifacts())["quantities"];
  const auto value = [&](const std::string& name) {
    return found["digit_verdicts.hbr." + name]["median"].get<double>();
  };

  const Hdf5Reader file(folder.path() / "digit_verdicts/00.h5");
  const auto image = file.read<std::uint8_t>("hbr/image").values;
  const auto z = file.read<float>("hbr/measures").values;
  const auto label = file.read<std::uint8_t>("hbr/label").values;
  const auto good = file.read<std::uint8_t>("hbr/good").values;
  const std::size_t n = label.size();
  const auto difference = [&](std::size_t i, std::size_t j) {
    double sum = 0;
    for (std::size_t p = 0; p < 784; ++p) sum += std::abs(image[784 * i + p] - image[784 * j + p]) / 255.0;
    return sum / 784;
  };
  double pairs = 0, neighbours = 0, borders = 0, at_borders = 0;
  std::set<std::pair<int, int>> cells;
  std::vector<int> goods(10), alls(10);
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t nearest = i;
    double least = 1e9;
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      if (j < i) pairs += difference(i, j);
      const double distance = std::hypot(z[2 * i] - z[2 * j], z[2 * i + 1] - z[2 * j + 1]);
      if (distance < least) least = distance, nearest = j;
    }
    neighbours += difference(i, nearest);
    if (label[i] != label[nearest]) at_borders += difference(i, nearest), borders += 1;
    int row = 0, column = 0;
    while (static_cast<double>(z[2 * i]) >= -1 + 0.1 * (row + 1)) ++row;
    while (static_cast<double>(z[2 * i + 1]) >= -1 + 0.1 * (column + 1)) ++column;
    cells.emplace(row, column);
    if (good[i]) goods[label[i]] += 1;
    alls[label[i]] += 1;
  }
  const double pair_count = 0.5 * static_cast<double>(n * (n - 1));
  EXPECT_NEAR(value("pair_difference"), pairs / pair_count, 1e-12);
  EXPECT_NEAR(value("neighbour_difference"), neighbours / static_cast<double>(n), 1e-12);
  ASSERT_GT(borders, 0);
  ASSERT_LT(borders, n);
  EXPECT_NEAR(value("border_difference"), at_borders / borders, 1e-12);
  EXPECT_DOUBLE_EQ(value("cells"), static_cast<double>(cells.size()) / 400);
  const int all = std::accumulate(goods.begin(), goods.end(), 0);
  EXPECT_DOUBLE_EQ(value("good"), all / static_cast<double>(n));
  EXPECT_DOUBLE_EQ(value("good_01"), (goods[0] + goods[1]) / 12.0);
  EXPECT_DOUBLE_EQ(value("classes"),
                   static_cast<double>(std::ranges::count_if(goods, [](int g) { return g >= 3; })));
  EXPECT_DOUBLE_EQ(value("good_of_class.4"), goods[4]);
  EXPECT_DOUBLE_EQ(value("all_of_class.4"), alls[4]);
  const auto doubles = [&](const char* name) {
    const auto floats = file.read<float>(name).values;
    return std::vector<double>(floats.begin(), floats.end());
  };
  EXPECT_DOUBLE_EQ(value("agreement"), rank_correlation(doubles("hbr/objective"), doubles("hbr/confidence")));
  EXPECT_DOUBLE_EQ(value("rarest"), 10.0 * std::ranges::min(goods) / all);
}

// Trained for four epochs, tested after some of them; what is wrong with it, or its curves.
TEST(Collect, LearningCurvesWhereTheyWereTested) {
  TemporaryFolder folder;
  const auto collected = [&](const std::vector<std::int64_t>& tested, const std::vector<double>& errors) {
    const std::filesystem::path path = folder.path() / "training.h5";
    Hdf5Writer file(path);
    file.write("training/epoch", std::vector<std::int64_t>{1, 2, 3, 4});
    file.write("training/samples", std::vector<std::int64_t>{8, 8, 8, 4});
    file.write("training/train_error", std::vector<double>{.4, .3, .2, .1});
    file.write("training/tested", tested);
    file.write("training/test_error", errors);
    file.write("training/kept_per_class", std::vector<double>(10, 0.5));
    file.write("latent/position", Array<float>{{2, 1}, {0.5f, 0.25f}});
    file.write("latent/label", std::vector<std::uint8_t>{1, 1});
    file.close();
    return collect_statistics("tiny", {{"autoencoder/00.h5", path}});
  };
  const json found = collected({1, 2, 4}, {.45, .35, .15});
  const json& curve = found["curves"]["autoencoder"];
  EXPECT_EQ(curve["at"], json({1., 2., 4.}));
  EXPECT_EQ(curve["test_error"]["median"], json({.45, .35, .15}));
  EXPECT_EQ(curve["train_error"]["median"], json({.4, .3, .1}));
  EXPECT_EQ(found["quantities"]["autoencoder.test_error"]["median"], .15);
  const auto refusal = [&](const std::vector<std::int64_t>& tested, const std::vector<double>& errors) {
    try {
      collected(tested, errors);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  EXPECT_THAT(refusal({1, 4}, {.1}), testing::HasSubstr("differ in length"));
  EXPECT_THAT(refusal({}, {}), testing::HasSubstr("are empty"));
  for (const std::vector<std::int64_t>& tested : {std::vector<std::int64_t>{1, 2}, {0, 4}, {2, 1, 4}, {4, 4}})
    EXPECT_THAT(refusal(tested, std::vector<double>(tested.size(), .1)),
                testing::HasSubstr("training/tested: expected some of training/epoch"));
}

TEST(Collect, RefusesWhatIsNotAsDescribed) {
  TemporaryFolder folder;
  const auto refuses = [&](const std::string& name, const auto& fill) {
    const std::filesystem::path path = folder.path() / "bad.h5";
    Hdf5Writer file(path);
    fill(file);
    file.close();
    EXPECT_THROW(collect_statistics("tiny", {{name, path}}), InputError) << name;
  };
  refuses("layer1/00.h5", [](Hdf5Writer&) {});
  refuses("accuracy/00.h5", [](Hdf5Writer& f) { f.write("n1/squared_error", std::vector<float>{}); });
  refuses("accuracy/00.h5", [](Hdf5Writer& f) { f.write("n1/squared_error", std::vector<float>{NAN}); });
  refuses("substitution/00.h5", [](Hdf5Writer& f) { f.write("original", std::vector<float>{1, 2, 3}); });
  refuses("judge.h5", [](Hdf5Writer&) {});
  refuses("nao_transfer/00.h5", [](Hdf5Writer& f) { f.write("absolute", std::vector<double>{1}); });
  refuses("nao_dynamics/00.h5", [](Hdf5Writer& f) { f.write("duration", std::vector<float>{}); });
  refuses("nao_tuned/00.h5", [](Hdf5Writer& f) {
    f.write("before/objective", std::vector<float>{1});
    f.write("before/good", std::vector<std::uint8_t>{1, 0});
  });
  refuses("digit_verdicts/00.h5", [](Hdf5Writer& f) {
    f.write("hbr/image", Array<std::uint8_t>{{1, 28, 28}, std::vector<std::uint8_t>(784)});
  });
  // Digits that are as described but for one array.
  const auto digits_with = [&](const std::string& odd) {
    const std::filesystem::path path = folder.path() / "bad.h5";
    Hdf5Writer file(path);
    const auto rows = [&](const std::string& array) { return array == odd ? 3u : 2u; };
    file.write("hbr/image", Array<std::uint8_t>{{2, 28, 28}, std::vector<std::uint8_t>(2 * 784)});
    file.write("hbr/measures", Array<float>{{rows("measures"), 2}, std::vector<float>(2 * rows("measures"))});
    for (const std::string array : {"objective", "confidence", "distance"})
      file.write("hbr/" + array, std::vector<float>(rows(array)));
    for (const std::string array : {"label", "good"})
      file.write("hbr/" + array, std::vector<std::uint8_t>(rows(array), odd == "class" ? 10 : 9));
    file.close();
    try {
      collect_statistics("tiny", {{"digit_verdicts/00.h5", path}});
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string("accepted");
  };
  for (const char* array : {"measures", "objective", "confidence", "distance", "label", "good"})
    EXPECT_THAT(digits_with(array), testing::HasSubstr("the arrays of hbr/ differ in length")) << array;
  EXPECT_THAT(digits_with("class"), testing::HasSubstr("hbr/label has a class above 9"));
  EXPECT_THAT(digits_with("none"), testing::Not(testing::HasSubstr("hbr/")));  // it lacks the flat ones
  EXPECT_THROW(collect_statistics("tiny", {{"layer9/00.h5", "nowhere"}}), InputError);
  EXPECT_THROW(collect_statistics("tiny", {{"layer1/00.h5", "nowhere"}}), InputError);
}

}  // namespace
}  // namespace hbr
