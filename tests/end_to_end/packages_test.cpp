// Which packages a user is told to install, by .ci/packages and its lists.
#include <gmock/gmock.h>

#include <iterator>
#include <sstream>

#include "tests/end_to_end/fake_folder.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::EndsWith;
using testing::HasSubstr;

// Calls .ci/packages on a machine that has but the commands that it needs, and these.
ShellResult packages_on(const std::map<std::string, std::string>& commands, const std::string& words) {
  const TemporaryFolder folder;
  const fs::path bin = folder.path() / "bin";
  fs::create_directories(bin);
  for (const char* name : {"awk", "bash", "cat", "comm", "dirname", "id", "paste", "sort", "tr"})
    fs::create_symlink(shell(std::string("printf %s $(command -v ") + name + ")").text, bin / name);
  for (const auto& [name, text] : commands) {
    std::ofstream(bin / name) << "#!/bin/bash\n" << text << '\n';
    fs::permissions(bin / name, fs::perms::owner_all);
  }
  return shell("PATH=" + bin.string() + " bash " HBR_SOURCE_DIR "/.ci/packages " + words);
}

// The first words of a file's rows, with how many words follow them.
std::map<std::string, int> rows(const std::string& file) {
  std::map<std::string, int> all;
  std::ifstream stream(HBR_SOURCE_DIR "/.ci/" + file);
  for (std::string line, package; std::getline(stream, line);) {
    std::istringstream row(line);
    if (line.starts_with('#') || !(row >> package)) continue;
    all[package] = static_cast<int>(std::distance(std::istream_iterator<std::string>(row), {}));
  }
  return all;
}

TEST(Packages, AreNamedElsewhere) {
  std::map<std::string, int> expected;
  for (const auto& [package, more] : rows("packages.txt")) expected[package] = 2;  // Fedora's and Arch's
  EXPECT_GT(expected.size(), 30u);
  EXPECT_EQ(rows("packages.elsewhere.txt"), expected);
}

TEST(Packages, ElsewhereAreACommandToCopy) {
  const ShellResult fedora = packages_on({{"dnf", ""}}, "auto test-cluster");
  EXPECT_EQ(fedora.code, 2);
  EXPECT_THAT(fedora.text,
              HasSubstr("DEPS=none. dnf install munge procps-ng slurm slurm-slurmctld slurm-slurmd\n"));
  // What is Arch's users' own is in no command.
  const ShellResult arch = packages_on({{"pacman", ""}}, "auto");
  EXPECT_EQ(arch.code, 2);
  EXPECT_THAT(arch.text,
              HasSubstr(" Out of the AUR: random123 simbody urdfdom. The others by: pacman -S --needed "));
  EXPECT_THAT(arch.text, EndsWith(" zlib\n"));
  EXPECT_THAT(packages_on({{"pacman", ""}}, "auto format").text,
              EndsWith("DEPS=none. pacman -S --needed clang\n"));
}

TEST(Packages, ThatATargetLacksAreNamedThoughNobodyInstallsThem) {
  const std::map<std::string, std::string> debian{
      {"dpkg-query", "echo python3-h5py installed; echo nodejs installed; exit 1"}};
  const ShellResult test = packages_on(debian, "none test");
  EXPECT_EQ(test.code, 0);
  EXPECT_EQ(test.text, "going on by DEPS=none without chromium python3-numpy, which make test may need\n");
  EXPECT_EQ(packages_on(debian, "none").text, "");
  EXPECT_EQ(packages_on({}, "none test").text, "");
}

}  // namespace
}  // namespace hbr
