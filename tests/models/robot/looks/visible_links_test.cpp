#include "models/robot/looks/visible_links.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(VisibleLinks, RodsStandForWhatCannotBeSeen) {
  std::vector<std::string> odd;
  const auto bare = visible_links(load(link("a") + link("b", "") + joint("j", "a", "b")), "", 1, odd);
  EXPECT_THAT(odd, ElementsAre(HasSubstr("no link shows anything")));
  EXPECT_EQ(bare[0].size(), 2u);  // a ball and a rod to the joint
  EXPECT_EQ(bare[1].size(), 1u);
  const std::string box = inertial() + R"(<visual><geometry><box size="1 1 1"/></geometry></visual>)";
  const std::string mesh = inertial() + R"(<visual><geometry><mesh filename="no.obj"/></geometry></visual>)";
  odd.clear();
  const auto some =
      visible_links(load(link("a", box) + link("b", mesh) + link("c", mesh) + link("frame", "") +
                         joint("j", "a", "b", "fixed", "") + joint("k", "b", "c", "fixed", "") +
                         joint("l", "c", "frame", "fixed", "")),
                    "", 1, odd);
  EXPECT_THAT(odd,
              ElementsAre(testing::AllOf(HasSubstr("mesh 'no.obj' is missing"), HasSubstr("; drawn as rods")),
                          HasSubstr("1 more link")));
  EXPECT_EQ(some[1].size(), 2u);
  EXPECT_TRUE(some[3].empty());
  // A sensor of some mass that shows nothing is left so.
  odd.clear();
  const auto sensor =
      visible_links(load(link("a", box) + link("b") + joint("j", "a", "b", "fixed", "")), "", 1, odd);
  EXPECT_THAT(odd, ElementsAre());
  EXPECT_TRUE(sensor[1].empty());
}

TEST(VisibleLinks, SayOnceWhatWasElsewhere) {
  const TestFolder folder;
  std::filesystem::create_directories(folder.path() / "meshes/visual");
  folder.write("meshes/visual/a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string mesh = R"(<visual><geometry><mesh filename="meshes/a.obj"/></geometry></visual>)";
  const RobotModel model = load_urdf(
      folder.write("a.urdf", robot(link("a", mesh + mesh) + link("b", mesh) + joint("j", "a", "b"))));
  std::vector<std::string> odd;
  EXPECT_EQ(visible_links(model, "", 1, odd)[0].size(), 2u);
  EXPECT_THAT(odd, ElementsAre(testing::AllOf(HasSubstr("mesh 'meshes/a.obj' is not where its name says"),
                                              HasSubstr("meshes/visual/a.obj (and 2 more)"))));
}

}  // namespace
}  // namespace hbr
