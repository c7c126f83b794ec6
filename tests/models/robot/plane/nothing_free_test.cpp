#include "models/robot/plane/nothing_free.h"

#include <gmock/gmock.h>

#include "models/robot/plane/reach.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

std::string turning(const char* name, const char* parent, const char* child, const char* origin,
                    const char* most = "3") {
  return fmt::format(
      R"(<joint name="{0}" type="revolute"><parent link="{1}"/><child link="{2}"/><origin xyz="{3}"/><axis xyz="0 1 0"/>
         <limit lower="-{4}" upper="{4}" effort="1" velocity="1"/></joint>)",
      name, parent, child, origin, most);
}
std::string ball(const char* radius, const char* place = "0 0 0") {
  return fmt::format(R"(<visual><origin xyz="{}"/><geometry><sphere radius="{}"/></geometry></visual>)",
                     place, radius);
}

// The last joint turns the tip inside a ball of the link before it.
TEST(NothingFree, NamesTheLinkThatHidesTheTip) {
  const RobotModel model =
      load(link("base", "") + link("arm", "") + link("shell", ball("0.4", "0.5 0 0")) + link("hand", "") +
           turning("a", "base", "arm", "0 0 1") + turning("b", "arm", "shell", "0.5 0 0") +
           turning("c", "shell", "hand", "0.5 0 0"));
  const Body body(model, {"a", "b", "c"});
  const int tip = model.link("hand");
  const Clearance clearance(body, tip);
  EXPECT_EQ(clearance.blocker(std::vector<double>{0.3, 0.4, 0.5}.data()), model.link("shell"));
  EXPECT_THAT([&] { Reach(body, tip, clearance, 300, 0, Seed(1)); },
              ThrowsMessage<InputError>(HasSubstr(
                  "in none of 300 configurations of a, b, c can 'hand' touch a board: link 'shell' reaches "
                  "beyond it whichever way a board faces; expected a tip_link farther out")));
}

// A hand that comes out of the ball of the base near its rest alone.
TEST(NothingFree, SaysWhenTheRobotRunsIntoItself) {
  const RobotModel model =
      load(link("base", ball("0.9", "0 0 0.4")) + link("arm", "") + link("hand", ball("0.05", "0.1 0 0")) +
           turning("a", "base", "arm", "0 0 1.4", "0.1") +
           R"(<joint name="s" type="prismatic"><parent link="arm"/><child link="hand"/><origin xyz="0 0 0"/>
              <axis xyz="0 0 -1"/><limit lower="0" upper="1" effort="1" velocity="1"/></joint>)");
  const Body body(model, {"a", "s"});
  const int tip = model.link("hand");
  const Clearance clearance(body, tip);
  EXPECT_EQ(clearance.blocker(std::vector<double>{0, 0.5}.data()), std::nullopt);
  EXPECT_THAT(
      nothing_free(body, clearance, tip, 7).what(),
      HasSubstr("in none of 7 configurations of a, s can 'hand' touch a board: the robot runs into itself"));
}

}  // namespace
}  // namespace hbr
