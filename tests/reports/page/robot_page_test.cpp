#include "reports/page/robot_page.h"

#include <gmock/gmock.h>

#include <fstream>

#include "pipeline/core/check.h"
#include "tests/reports/page/small_shape.h"
#include "tests/support/temporary_folder.h"
#include "tests/support/unpacked.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class RobotPages : public testing::Test {
 protected:
  RobotPages() {
    Hdf5Writer file(folder_.path() / "shape.h5");
    write_small_shape(file);
    file.close();
    fs::create_directories(folder_.path() / "three");
    for (const char* name : {"LICENSE", "OrbitControls.js", "three.module.min.js"})
      std::ofstream(folder_.path() / "three" / name) << name;
  }
  std::string page(const char* three) const {
    return robot_page(
        {"a<b>", folder_.path() / "shape.h5", "mass 1 kg & <more>", {{"a #b.png", "As it \"stands\"."}}},
        folder_.path() / three);
  }
  TemporaryFolder folder_;
};

TEST_F(RobotPages, HoldTheRobotAndWhatIsToldOfIt) {
  const std::string html = page("three");
  EXPECT_THAT(html, HasSubstr("<h1>a&lt;b&gt;</h1>"));
  EXPECT_THAT(html, HasSubstr("mass 1 kg &amp; &lt;more&gt;</pre>"));
  EXPECT_THAT(html, HasSubstr("<img src=\"a%20%23b.png\" alt=\"As it &quot;stands&quot;.\">"));
  const nlohmann::json words = Unpacked(html, "robot-shown").header["words"];
  EXPECT_EQ(words["joints"], "j");
  EXPECT_EQ(words["parts"].size(), 2u);
  EXPECT_FALSE(words.contains("plane"));
  EXPECT_NO_THROW(Unpacked(html, "three"));
  for (const char* foreign : {"src=\"http", "href=\"http", "url(http", "@import", "<link", "{{"})
    EXPECT_THAT(html, Not(HasSubstr(foreign)));
}

TEST_F(RobotPages, SayWhenNothingTurns) {
  const std::string html = page("nowhere");
  EXPECT_THAT(html, HasSubstr("three.js could not be had"));
  EXPECT_THAT(html, Not(HasSubstr("id=\"pack-three")));
  EXPECT_THAT(page("three"), Not(HasSubstr("could not be had")));
}

}  // namespace
}  // namespace hbr
