#include "stages/plan/profile_name.h"

#include <gmock/gmock.h>

#include <fstream>

#include "pipeline/core/check.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(ProfileName, IsANameOrAFile) {
  const TemporaryFolder folder;
  const fs::path profiles = folder.path() / "profiles", mine = folder.path() / "mine.toml",
                 plain = folder.path() / "plain";
  fs::create_directories(profiles);
  for (const fs::path& file : {profiles / "paper.toml", profiles / "lines.toml", mine, plain})
    std::ofstream(file) << "name = 1";
  const auto file_of = [&](const std::string& word) { return profile_file(word, profiles); };
  EXPECT_EQ(file_of("paper"), profiles / "paper.toml");
  EXPECT_EQ(file_of(mine.string()), mine);
  EXPECT_EQ(file_of((folder.path() / "mine").string()), mine);  // not looked for among the names
  EXPECT_EQ(file_of(plain.string()), plain);
  EXPECT_EQ(file_of("none.toml"), "none.toml");

  const auto complaint = [&](const std::string& word) -> std::string {
    try {
      return "found " + file_of(word).string();
    } catch (const InputError& error) {
      return error.what();
    }
  };
  EXPECT_EQ(complaint("papr"),
            "no profile 'papr' (did you mean 'paper'?); expected one of lines, paper, or a file.toml");
  EXPECT_THAT(complaint((folder.path() / "none").string()),
              HasSubstr("there is no such file, nor with .toml"));
  EXPECT_THAT(complaint(profiles.string()),
              HasSubstr("this is a folder; expected a file.toml, or a name out of"));
  EXPECT_THAT(complaint(""), HasSubstr("no profile ''"));
}

}  // namespace
}  // namespace hbr
