#include "pipeline/artifact/families.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <regex>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

using testing::UnorderedElementsAre;

// "a -> b" by the labels of the boxes, of which only the first lines are kept.
std::set<std::string> arrows(const std::vector<StageBox>& stages, std::set<std::string>* labels = nullptr) {
  const std::string dot = stages_as_dot(stages, {"line", "text", "fill"});
  std::map<std::string, std::string> label;
  const std::regex box("(f[0-9]+) \\[label=\"([^\"]*)\"\\]"), arrow("(f[0-9]+) -> (f[0-9]+);");
  for (auto at = std::sregex_iterator(dot.begin(), dot.end(), box); at != std::sregex_iterator(); ++at) {
    label[(*at)[1]] = (*at)[2];
    if (labels) labels->insert((*at)[2]);
  }
  std::set<std::string> found;
  const auto name = [&](const std::string& id) { return label.at(id).substr(0, label.at(id).find("\\n")); };
  for (auto at = std::sregex_iterator(dot.begin(), dot.end(), arrow); at != std::sregex_iterator(); ++at)
    found.insert(name((*at)[1]) + " > " + name((*at)[2]));
  return found;
}

TEST(Families, ReplicationsAndSiblingsAreOneBoxWithACount) {
  std::set<std::string> labels;
  const auto found = arrows({{"layer1", "", 50, {}},
                             {"layer2_n1", "", 50, {"layer1"}},
                             {"layer2_n10", "", 50, {"layer1"}},
                             {"nao_plane", "", 1, {"layer1"}},
                             {"big_arm_plane", "", 1, {"layer1"}},
                             {"nao_draws", "", 10, {"nao_plane", "layer2_n10"}},
                             {"big_arm_draws", "", 10, {"big_arm_plane", "layer2_n10"}}},
                            &labels);
  EXPECT_THAT(labels, UnorderedElementsAre("layer1\\n\u00d7 50", "layer2*\\n2 stages, \u00d7 100",
                                           "*_plane\\n2 stages, \u00d7 2", "*_draws\\n2 stages, \u00d7 20"));
  EXPECT_THAT(found, UnorderedElementsAre("layer1 > layer2*", "layer1 > *_plane", "layer2* > *_draws",
                                          "*_plane > *_draws"));
}

// No box stands alone that needs something, however many it needs.
TEST(Families, ArrowsThatOthersImplyAreLeftOutAndNoneElse) {
  const auto found = arrows({{"a", "", 1, {}},
                             {"b", "", 1, {"a"}},
                             {"c", "", 1, {"a", "b"}},
                             {"d", "", 1, {"a"}},
                             {"all", "", 1, {"a", "b", "c", "d"}}});
  EXPECT_THAT(found, UnorderedElementsAre("a > b", "b > c", "a > d", "c > all", "d > all"));
}

TEST(Families, ACircleIsRefused) {
  EXPECT_THROW(stages_as_dot({{"a", "", 1, {"b"}}, {"b", "", 1, {"a"}}}, {"", "", ""}), InputError);
}

}  // namespace
}  // namespace hbr
