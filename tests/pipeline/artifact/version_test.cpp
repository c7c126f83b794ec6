// The version of a checkout, of an archive made of it, and of neither; with the project's own .gitattributes.
#include "pipeline/artifact/version.h"

#include <gmock/gmock.h>

#include <cstdlib>
#include <fstream>

#include "pipeline/process/run_child.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::MatchesRegex;

class Version : public testing::Test {
 protected:
  // Its path has what a shell would take for its own.
  const TemporaryFolder folder_;
  const fs::path repository_ = folder_.path() / "it's a $repository";

  void SetUp() override {
    fs::create_directories(repository_);
    fs::copy(HBR_SOURCE_DIR "/.gitattributes", repository_);
    std::string told;
    std::getline(std::ifstream(HBR_SOURCE_DIR "/.version"), told);
    if (!told.starts_with('$')) told = "$Format:%(describe:tags=true) %h$";  // these sources are an archive's
    std::ofstream(repository_ / ".version") << told << '\n';
    git({"init", "-q"});
    git({"add", "."});
    git({"-c", "user.name=a", "-c", "user.email=a@b.c", "commit", "-q", "-m", "first"});
  }
  void git(std::vector<std::string> words) {
    words.insert(words.begin(), {"git", "-C", repository_.string()});
    ASSERT_EQ(run_child(words).exit_code, 0) << words[3];
  }
  fs::path unpacked(const fs::path& at) {
    fs::create_directories(at);
    git({"archive", "-o", (folder_.path() / "sources.tar").string(), "HEAD"});
    EXPECT_EQ(
        run_child({"tar", "-xf", (folder_.path() / "sources.tar").string(), "-C", at.string()}).exit_code, 0);
    return at;
  }
};

TEST_F(Version, IsWhatGitSays) {
  EXPECT_THAT(version_of(repository_), MatchesRegex("[0-9a-f]{7,}"));
  git({"tag", "v1.2"});
  EXPECT_EQ(version_of(repository_), "v1.2");
  std::ofstream(repository_ / ".gitattributes") << "changed\n";
  EXPECT_EQ(version_of(repository_), "v1.2-dirty");
}

TEST_F(Version, StaysWithAnArchive) {
  const std::string version = version_of(repository_);
  EXPECT_EQ(version_of(unpacked(folder_.path() / "untagged")), version);
  git({"tag", "v1.2"});
  EXPECT_EQ(version_of(unpacked(folder_.path() / "tagged")), "v1.2");
}

TEST_F(Version, IsNeverThatOfARepositoryFurtherUp) {
  git({"tag", "outer"});
  fs::create_directories(repository_ / "inner");
  EXPECT_EQ(version_of(repository_ / "inner"), "unknown");
  std::ofstream(repository_ / "inner/.version") << "v3-4-gabcdef abcdef\n";
  EXPECT_EQ(version_of(repository_ / "inner"), "v3-4-gabcdef");
}

TEST_F(Version, IsUnknownWhereNobodySaid) {
  fs::remove_all(repository_ / ".git");
  EXPECT_EQ(version_of(repository_), "unknown");
  fs::remove(repository_ / ".version");
  EXPECT_EQ(version_of(repository_), "unknown");
}

}  // namespace
}  // namespace hbr
