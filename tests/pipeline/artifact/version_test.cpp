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
    if (!told.starts_with('$')) told = "$Format:%h$";  // these sources are an archive's
    std::ofstream(repository_ / ".version") << told << '\n';
    std::ofstream(repository_ / "CITATION.cff") << "type: software\nversion: 1.2.3\nyear: 2018\n";
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

TEST_F(Version, IsTheReleaseAndWhatGitSays) {
  EXPECT_THAT(version_of(repository_), MatchesRegex("1\\.2\\.3\\+[0-9a-f]{7,}"));
  const std::string version = version_of(repository_);
  git({"tag", "v7"});
  EXPECT_EQ(version_of(repository_), version) << "a tag is not a second place for the release";
  std::ofstream(repository_ / ".gitattributes") << "changed\n";
  EXPECT_EQ(version_of(repository_), version + "-dirty");
}

TEST_F(Version, StaysWithAnArchive) {
  EXPECT_EQ(version_of(unpacked(folder_.path() / "unpacked")), version_of(repository_));
}

TEST_F(Version, IsNeverThatOfARepositoryFurtherUp) {
  fs::create_directories(repository_ / "inner");
  EXPECT_EQ(version_of(repository_ / "inner"), "unknown+unknown");
  fs::copy(repository_ / "CITATION.cff", repository_ / "inner");
  EXPECT_EQ(version_of(repository_ / "inner"), "1.2.3+unknown");
  std::ofstream(repository_ / "inner/.version") << "abcdef0\n";
  EXPECT_EQ(version_of(repository_ / "inner"), "1.2.3+abcdef0");
}

TEST_F(Version, IsUnknownWhereNobodySaid) {
  fs::remove_all(repository_ / ".git");
  EXPECT_EQ(version_of(repository_), "1.2.3+unknown");
  fs::remove(repository_ / ".version");
  fs::remove(repository_ / "CITATION.cff");
  EXPECT_EQ(version_of(repository_), "unknown+unknown");
}

// A release of these sources is three numbers, so that CMake and users can compare it.
TEST(Release, IsThreeNumbers) {
  EXPECT_THAT(version_of(HBR_SOURCE_DIR), MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+\\+.+"));
}

}  // namespace
}  // namespace hbr
