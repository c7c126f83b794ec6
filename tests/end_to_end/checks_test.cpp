// The scripts behind make's checks, with stand-ins for the programs that they call.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <regex>

#include "tests/end_to_end/fake_folder.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

std::string text_in(const fs::path& file) {
  std::ifstream stream(file);
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

class Checks : public testing::Test {
 protected:
  const TemporaryFolder folder_;
  const fs::path checkout_ = folder_.path() / "checkout", bin_ = folder_.path() / "bin";

  void SetUp() override {
    fs::create_directories(checkout_ / "tests");
    fs::copy(HBR_SOURCE_DIR "/Makefile", checkout_);
    fs::copy(HBR_SOURCE_DIR "/.ci", checkout_ / ".ci");
    for (const char* script : {"fuzz", "mutation", "releases"})
      fs::copy(std::string(HBR_SOURCE_DIR "/tests/") + script, checkout_ / "tests" / script,
               fs::copy_options::recursive);
  }
  void program(const std::string& name, const std::string& text) {
    fs::create_directories(bin_);
    std::ofstream(bin_ / name) << "#!/bin/bash\n" << text << '\n';
    fs::permissions(bin_ / name, fs::perms::owner_all);
  }
  void source(const std::string& name, const std::string& text) {
    fs::create_directories((checkout_ / name).parent_path());
    std::ofstream(checkout_ / name) << text;
  }
  // In the checkout, where no setting of a user's says whose repositories are to be trusted.
  ShellResult run(const std::string& words) {
    return shell("cd " + checkout_.string() + " && PATH=" + bin_.string() +
                 ":$PATH GIT_CONFIG_GLOBAL=/dev/null GIT_CONFIG_SYSTEM=/dev/null " + words);
  }
  void repository_of_another_user() {
    ASSERT_EQ(run("git init -q && git add -A").code, 0);
    ASSERT_EQ(run("chown -R 65534:65534 .").code, 0);
    ASSERT_NE(run("git ls-files").code, 0);
  }
};

TEST_F(Checks, TheFormatOfAnotherUsersCheckoutIsLookedAt) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can give files to another user";
  source("pipeline/a.cpp", "");
  program("clang-format", "echo clang-format \"$@\"");
  repository_of_another_user();
  for (const char* goal : {"check-format", "format"}) {
    const ShellResult outcome = run(std::string("make DEPS=none ") + goal);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("pipeline/a.cpp"));
  }
}

// Stand-ins for the build and for the tests, which notice that a condition is denied.
TEST_F(Checks, MutantsAreOfTheSourcesThatAreThere) {
  source("pipeline/statistics/a.cpp", "  if (n > 0) throw InputError(\"n is {}\", n);\n");
  source("pipeline/statistics/gone.cpp", "");
  program("cmake",
          "[ \"$1\" = --build ] || { mkdir -p \"$4\"; exit; }\nmkdir -p \"$2/bin\"\n"
          "printf \"#!/bin/bash\\n! grep -q \\\"!(n > 0)\\\" $2/../tree/pipeline/statistics/a.cpp\\n\" "
          ">\"$2/bin/$4\"\nchmod +x \"$2/bin/$4\"");
  if (::geteuid() == 0)
    repository_of_another_user();
  else
    ASSERT_EQ(run("git init -q && git add -A").code, 0);
  const std::string line = "make DEPS=none mutate FILES=pipeline/statistics";
  const ShellResult outcome = run(line);
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text,
              HasSubstr("1/60 noticed by test_pipeline_statistics: pipeline/statistics/a.cpp:1: negated"));
  EXPECT_THAT(outcome.text, HasSubstr("1 of 1 noticed"));
  const fs::path copy = checkout_ / "build/mutate/tree/pipeline/statistics";
  EXPECT_TRUE(fs::exists(copy / "gone.cpp"));
  fs::remove(checkout_ / "pipeline/statistics/gone.cpp");
  EXPECT_EQ(run(line).code, 0);
  EXPECT_FALSE(fs::exists(copy / "gone.cpp"));
  EXPECT_TRUE(fs::exists(copy / "a.cpp"));
}

TEST_F(Checks, NumbersThatAreNoneAreRefusedBeforeAnythingIsBuilt) {
  for (const auto& [goal, name, value, least] :
       std::vector<std::array<std::string, 4>>{{"fuzz", "SECONDS", "abc", "1"},
                                               {"fuzz", "SECONDS", "0", "1"},
                                               {"fuzz", "SECONDS", "", "1"},
                                               {"fuzz", "SECONDS", "-5", "1"},
                                               {"fuzz", "SECONDS", "2.5", "1"},
                                               {"mutate", "COUNT", "0", "1"},
                                               {"mutate", "COUNT", "many", "1"},
                                               {"mutate", "SEED", "1e3", "0"}}) {
    const ShellResult outcome = run("make DEPS=none " + goal + " " + name + "=" + value);
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.text, testing::StartsWith(name + " is \'" + value +
                                                  "\'; expected a whole number from " + least + "\nmake: "));
    EXPECT_EQ(std::ranges::count(outcome.text, '\n'), 2) << outcome.text;  // the other is make's own
    EXPECT_FALSE(fs::exists(checkout_ / "build/fuzz"));
  }
  const ShellResult script = run("tests/fuzz/run . 0");
  EXPECT_EQ(script.code, 2);
  EXPECT_EQ(script.text, "SECONDS is \'0\'; expected a whole number from 1\n");
}

TEST_F(Checks, OfNothingAreNoSuccess) {
  for (const auto& [goal, name] : {std::pair<std::string, std::string>{"check-targets", "COMPILERS"},
                                   {"check-targets", "TARGETS"},
                                   {"check-releases", "RELEASES"},
                                   {"mutate", "FILES"}}) {
    const ShellResult outcome = run("make DEPS=none " + goal + " " + name + "=");
    EXPECT_EQ(outcome.code, 2);
    EXPECT_THAT(outcome.text, HasSubstr(name + " is empty: leave it out for its default"));
  }
  program("cmake", "");
  program("ninja",
          "[[ $* != *targets* ]] || echo a/Unity/unity_0_cxx.cxx.o: x; [[ $* != *-k* ]] || touch compiled");
  const ShellResult nothing = run("make DEPS=none check-targets COMPILERS=g++ TARGETS=native OBJECTS=b");
  EXPECT_EQ(nothing.code, 2);
  EXPECT_THAT(nothing.text, HasSubstr("OBJECTS is \'b\': no object has such a path; "));
  EXPECT_FALSE(fs::exists(checkout_ / "compiled"));
  EXPECT_EQ(run("make DEPS=none check-targets COMPILERS=g++ TARGETS=native OBJECTS=a/").code, 0);
  EXPECT_TRUE(fs::exists(checkout_ / "compiled"));
}

TEST_F(Checks, OfTargetsTakeFilesTogetherOrOneByOne) {
  program("cmake", "echo cmake \"$@\"");
  program("ninja", "[[ $* != *targets* ]] || echo a.cpp.o: x");
  for (const auto& [words, told] :
       {std::pair<std::string, std::string>{"", "-DHBR_UNITY=ON"}, {"UNITY=0", "-DHBR_UNITY=OFF"}}) {
    const ShellResult outcome = run("make DEPS=none check-targets COMPILERS=g++ TARGETS=native " + words +
                                    " && grep ^cmake build/targets/g++-native/log.txt");
    EXPECT_THAT(outcome.text, HasSubstr(told));
  }
}

// Of who calls a bare machine knows whether warnings are errors, and no compiler.
TEST_F(Checks, OfReleasesHandOnWhetherWarningsAreErrors) {
  program("id", "echo 0");
  program("debootstrap",
          "mkdir -p $3/etc/dpkg/dpkg.cfg.d $3/root/hbr/out/reduced && cd $3/root/hbr/out/reduced\n"
          "mkdir layer1 layer2 reference4d layer3 flat_arcs && touch layer1/00.h5");
  program("mount", "");
  program("unshare", "while [[ $1 = --* ]]; do shift; done; exec \"$@\"");
  program("chroot", "shift; echo \"$@\"; echo tests passed");
  for (const std::string given : {"WERROR=1", ""}) {
    const ShellResult outcome =
        run("env -u WERROR make DEPS=none check-releases RELEASES=some MIRROR=m CXX=some++ " + given +
            " && cat build/releases/some.log");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("env -i PATH="));
    EXPECT_EQ(outcome.text.find(" WERROR=1 ") != std::string::npos, !given.empty()) << outcome.text;
    EXPECT_THAT(outcome.text, Not(HasSubstr("some++")));
  }
}

// The tests and cases of a cluster that tests/README.md names for the faults that a run may meet.
TEST(PageOfTests, NamesTestsThatAreThere) {
  std::string sources;
  for (const auto& entry : fs::recursive_directory_iterator(HBR_SOURCE_DIR "/tests"))
    if (entry.path().string().ends_with("_test.cpp")) sources += text_in(entry.path());
  const std::string cases = text_in(HBR_SOURCE_DIR "/tests/cluster/run");
  std::string page = text_in(HBR_SOURCE_DIR "/tests/README.md");
  page = page.substr(page.find("## Faults"));
  page = page.substr(page.find("|---|"));
  const std::regex name("`((\\w+)\\.([A-Z]\\w+|\\*)|[a-z]+(_[a-z]+)+)`");
  int tests = 0, of_clusters = 0;
  for (std::sregex_iterator at(page.begin(), page.end(), name), end; at != end; ++at) {
    const std::string suite = (*at)[2], test = (*at)[3];
    if (suite.empty()) {
      EXPECT_THAT(cases, HasSubstr("\n" + (*at)[1].str() + "() {")) << (*at)[1];
      ++of_clusters;
      continue;
    }
    const std::string rest = suite + ", " + (test == "*" ? "" : test + ")");
    EXPECT_TRUE(sources.find("TEST(" + rest) != std::string::npos ||
                sources.find("TEST_F(" + rest) != std::string::npos)
        << (*at)[1];
    ++tests;
  }
  EXPECT_GT(tests, 20);
  EXPECT_GT(of_clusters, 8);
}

}  // namespace
}  // namespace hbr
