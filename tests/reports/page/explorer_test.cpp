#include "reports/page/explorer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/artifact/unit_columns.h"
#include "pipeline/core/check.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/unpacked.h"

namespace hbr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

class ExplorerTest : public testing::Test {
 protected:
  // A layer of three elites, with ids up to `last`.
  std::filesystem::path write(const std::string& name, std::int64_t last) {
    const std::filesystem::path path = folder_.path() / (name + ".h5");
    Hdf5Writer file(path);
    file.write("layer2/id", std::vector<std::int64_t>{4, 5, last});
    file.write("layer2/parent", std::vector<std::int64_t>{-1, 4, 4});
    file.write("layer2/objective", std::vector<float>{-1, -2, -3});
    file.write("layer2/solution", {3, 2}, std::vector<float>{0, 1, 0.5f, 0.25f, 1, 0}.data());
    file.write("layer2/measures", {3, 1}, std::vector<float>{0.1f, 0.2f, 0.3f}.data());
    file.write("layer2/stops", {3, 1, 2}, std::vector<std::int32_t>{7, 8, 9, -1, 65534, 0}.data());
    write_unit_columns(file, "layer2/solution", {{"a", "b"}, {"m", ""}, 0, 1, {-1, 0}, {1, 2}});
    write_unit_columns(file, "layer2/measures", {{"c"}, {"rad"}, 0, 1, {0}, {3}});
    write_value_meaning(file, "layer2/objective", {"minus the cost", "rad^2"});
    file.attribute("layer2.layer", std::string("layer2_n10"));
    file.attribute("layer2.kind", std::string("lines"));
    file.attribute("layer2.batch", std::int64_t{100});
    file.attribute("half_side", 0.6);
    file.write("links", std::vector<float>{0.5f, 0.25f});
    file.close();
    return path;
  }
  TemporaryFolder folder_;
};

TEST_F(ExplorerTest, PacksWhatTheArtifactsHold) {
  const Artifacts artifacts({{"explorer/00.h5", write("00", 1'000'000)}, {"explorer/01.h5", write("01", 6)}});
  const std::string page = explorer_packs(artifacts, "mine");
  EXPECT_EQ(Unpacked(page, "explorer").header.at("words"),
            (nlohmann::json{{"profile", "mine"}, {"replications", {"00", "01"}}}));
  for (const auto& [name, last] : {std::pair("explorer-00", 1'000'000), std::pair("explorer-01", 6)}) {
    const Unpacked pack(page, name);
    EXPECT_THAT(pack.read<std::int32_t>("layer2/id"), ElementsAre(4, 5, last));
    EXPECT_THAT(pack.read<std::int32_t>("layer2/parent"), ElementsAre(-1, 4, 4));
    EXPECT_THAT(pack.read<float>("layer2/solution"), ElementsAre(0, 1, 0.5f, 0.25f, 1, 0));
    EXPECT_THAT(pack.read<std::uint16_t>("layer2/stops"), ElementsAre(7, 8, 9, 65535, 65534, 0));
    EXPECT_THAT(pack.shape("layer2/stops"), ElementsAre(3, 1, 2));
    const nlohmann::json& words = pack.header.at("words");
    EXPECT_EQ(words.at("links"), nlohmann::json({0.5, 0.25}));
    EXPECT_EQ(words.at("half_side"), 0.6);
    EXPECT_EQ(words.at("layers"), nlohmann::json::parse(R"([{"group": "layer2", "layer": "layer2_n10",
      "kind": "lines", "batch": 100, "fitness": {"meaning": "minus the cost", "units": "rad^2"},
      "genes": {"names": ["a", "b"], "units": ["m", ""], "low": 0, "high": 1, "from": [-1, 0], "to": [1, 2]},
      "descriptor": {"names": ["c"], "units": ["rad"], "low": 0, "high": 1, "from": [0], "to": [3]}}])"));
  }
  EXPECT_THAT(explorer_html(artifacts), HasSubstr("needs scripts"));
}

TEST_F(ExplorerTest, SaysWhereThereIsNothing) {
  const Artifacts none({});
  EXPECT_EQ(explorer_packs(none, "mine"), "");
  EXPECT_THAT(explorer_html(none), HasSubstr("no digits to explore"));
  EXPECT_THAT(explorer_html(none), Not(HasSubstr("explorer-app")));
  const Artifacts large({{"explorer/00.h5", write("00", std::int64_t{1} << 31)}});
  EXPECT_THAT([&] { explorer_packs(large, "mine"); },
              ThrowsMessage<InputError>(HasSubstr("layer2/id: 2147483648 does not fit into 32 bits")));
}

}  // namespace
}  // namespace hbr
