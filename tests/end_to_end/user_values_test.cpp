// What a user gives on make's command line or in the environment reaches the programs letter by letter, or is
// refused in one line. Stand-ins for the programs tell what they were given.
#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "tests/end_to_end/fake_folder.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

const std::vector<std::string> kOdd{"dol$lar",
                                    "two words",
                                    "it's",
                                    "\"x\"",
                                    "`y`",
                                    "a#b",
                                    "a%b:c",
                                    "*",
                                    "ünï/cödé",
                                    "back\\slash",
                                    "$(shell touch pwned)",
                                    "x; touch pwned",
                                    "$$",
                                    "a,b(c)",
                                    "&& touch pwned | x",
                                    "a=b"};

class UserValues : public testing::Test {
 protected:
  void SetUp() override { set_up(folder_.path() / "checkout"); }
  void TearDown() override {
    for (const std::string& name : given_) ::unsetenv(name.c_str());
  }
  void set_up(const fs::path& checkout) {
    checkout_ = checkout;
    fs::create_directories(checkout_);
    fs::copy(HBR_SOURCE_DIR "/Makefile", checkout_);
    fs::copy(HBR_SOURCE_DIR "/.ci", checkout_ / ".ci");
    fs::create_directories(checkout_ / "pipeline");
    for (const char* script : {"fetch_mnist.sh", "fetch_three.sh"})
      program(checkout_ / "pipeline" / script, "");
    std::ofstream(checkout_ / "CMakeLists.txt") << "cmake_minimum_required(VERSION 3.25)\n"
                                                   "project(stand_in LANGUAGES NONE)\n"
                                                   "add_custom_target(programs)\nadd_custom_target(robot)\n";
    for (const char* name : {"hbr", "robot", "reference", "publish", "export_repertoires", "compare"})
      program(checkout_ / "build/release/bin" / name,
              "printf \"<%s>\" ${0##*/} \"$@\" \"MNIST_DIR=${MNIST_DIR-}\" \"OUT=${OUT-none}\"; echo");
  }
  static void program(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << "#!/bin/bash\n" << text << "\n";
    fs::permissions(file, fs::perms::owner_all);
  }
  // The values travel by the environment, so that this test's own shell does not touch them.
  ShellResult make(const std::string& goal, const std::map<std::string, std::string>& values,
                   bool by_environment) {
    std::string words, others;
    for (const char* name :
         {"OUT",     "PROFILE", "BUILD",  "LAUNCH",   "RETRY", "THREADS",  "REP",   "MNIST_DIR",
          "URDF",    "MESHES",  "POSE",   "FORMAT",   "STAGE", "TO",       "A",     "B",
          "GROUP",   "PREFIX",  "CXX",    "HBR_ARCH", "TESTS", "READER",   "FILES", "COMPILERS",
          "OBJECTS", "TARGETS", "LINKED", "RELEASES", "CASES", "SANITIZER"})
      if (!values.contains(name)) others += std::string(" -u ") + name;
    for (const auto& [name, value] : values) {
      given_.push_back((by_environment ? "" : "GIVEN_") + name);
      ::setenv(given_.back().c_str(), value.c_str(), 1);
      if (!by_environment) words += " " + name + "=\"$GIVEN_" + name + "\"";
    }
    ::setenv("CHECKOUT", checkout_.c_str(), 1);
    given_.push_back("CHECKOUT");
    const ShellResult outcome = shell("env" + others + " make -C \"$CHECKOUT\" DEPS=none " + goal + words +
                                      " 2>&1 | grep -v \"^make.*directory\"");
    TearDown();
    given_.clear();
    EXPECT_FALSE(fs::exists(checkout_ / "pwned"));
    return outcome;
  }

  static std::string text_of(const fs::path& file) {
    std::ifstream stream(file);
    return std::string(std::istreambuf_iterator<char>(stream), {});
  }

  const TemporaryFolder folder_;
  fs::path checkout_;
  std::vector<std::string> given_;
};

TEST_F(UserValues, ReachTheProgramsLetterByLetter) {
  bool by_environment = false;
  for (const std::string& odd : kOdd) {
    const std::map<std::string, std::string> all{
        {"OUT", odd}, {"PROFILE", odd + ".toml"}, {"LAUNCH", odd}, {"THREADS", odd}, {"RETRY", odd},
        {"REP", odd}, {"MNIST_DIR", odd}};
    for (const bool both_ways : {false, true})
      EXPECT_THAT(make("status", all, both_ways).text,
                  HasSubstr("<hbr><status><--profile><" + odd + ".toml><--out><" + odd + "><--threads><" +
                            odd + "><--launch><" + odd + "><--retry><" + odd + "><--replication><" + odd +
                            "><MNIST_DIR=" + odd + ">"));
    by_environment = !by_environment;  // each way with every other: a make takes a third of a second
    EXPECT_THAT(make("verify", {{"OUT", odd}}, by_environment).text,
                HasSubstr("<reference><verify><" + odd + "><reports/reference>"));
    EXPECT_THAT(
        make("export", {{"OUT", odd}, {"FORMAT", odd}, {"STAGE", odd}, {"REP", odd}}, by_environment).text,
        HasSubstr("<export_repertoires><" + odd + "><" + odd + "><" + odd + "/export><" + odd + "><" + odd +
                  ">"));
    EXPECT_THAT(make("export", {{"OUT", odd}, {"FORMAT", "qdax"}, {"TO", odd}}, by_environment).text,
                HasSubstr("<export_repertoires><" + odd + "><qdax><" + odd + "><><>"));
    EXPECT_THAT(make("compare", {{"A", odd}, {"B", odd}}, by_environment).text,
                HasSubstr("<compare><" + odd + "><" + odd + "><out/compare>"));
    EXPECT_THAT(make("compare", {{"A", odd}, {"B", odd}, {"OUT", odd}}, by_environment).text,
                HasSubstr("<compare><" + odd + "><" + odd + "><" + odd + ">"));
    EXPECT_THAT(
        make("robot", {{"OUT", odd}, {"URDF", odd}, {"MESHES", odd}, {"POSE", "a=1 *=2"}}, by_environment)
            .text,
        HasSubstr("<robot><" + odd + "><" + odd + "><" + odd + "><a=1><*=2>"));
    EXPECT_THAT(make("help", {{"OUT", odd}, {"PREFIX", odd}}, by_environment).text,
                AllOf(HasSubstr("OUT=" + odd + "   where"), HasSubstr("PREFIX=" + odd + "\n")));
  }
}

// What builds and checks are given, and the words of what may be several.
TEST_F(UserValues, ReachTheChecksLetterByLetter) {
  const std::string tell = "printf \"<%s>\" ${0##*/} \"$@\"; echo";
  for (const char* script : {".ci/targets", "tests/fuzz/run", "tests/releases/try.sh", "tests/cluster/run"})
    program(checkout_ / script, tell);
  for (const char* command : {"cmake", "python3", "ctest"}) program(folder_.path() / "bin" / command, tell);
  for (const char* build : {"release", "sanitize", "fuzz", "odr"})
    fs::create_directories(checkout_ / "build" / build);
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", ((folder_.path() / "bin").string() + ":" + path).c_str(), 1);
  bool by_environment = false;
  for (const std::string odd :
       {"a$|b", "two words", "it's a \"x\"", "a#b%c:d/e", "$(shell touch pwned)", "x; touch pwned"}) {
    by_environment = !by_environment;
    const auto told = [&](const std::string& goal, const std::map<std::string, std::string>& values) {
      return make(goal, values, by_environment).text;
    };
    // The words of odd, each with what stands before it.
    const auto words = [&](const std::string& text, const std::string& before) {
      std::istringstream stream(text);
      std::string all;
      for (std::string word; stream >> word;) all += "<" + before + word + ">";
      return all;
    };
    EXPECT_THAT(told("check-targets", {{"COMPILERS", odd}, {"TARGETS", odd}, {"OBJECTS", odd}}),
                HasSubstr("<targets><build/targets><" + odd + "><" + odd + "><" + odd + ">"));
    EXPECT_THAT(told("fuzz", {{"READER", odd}}), HasSubstr("<run><build/fuzz><60>" + words(odd, "")));
    EXPECT_THAT(told("mutate", {{"FILES", odd}}), HasSubstr("<60><-->" + words(odd, "")));
    EXPECT_THAT(told("check-odr", {{"LINKED", odd}}), HasSubstr("<build/odr><--target>" + words(odd, "")));
    EXPECT_THAT(told("test-cluster", {{"CASES", odd}}), HasSubstr("<run>" + words(odd, "")));
    EXPECT_THAT(told("check-releases", {{"RELEASES", odd}}),
                HasSubstr("<try.sh><" + odd.substr(0, odd.find(' '))));
    std::string name = odd;
    std::ranges::replace(name, '/', '_');
    EXPECT_THAT(told("sanitize", {{"TESTS", odd}}), HasSubstr(words(name, "test_")));
    EXPECT_THAT(told("sanitize", {{"SANITIZER", odd}}), HasSubstr("SANITIZER is '" + odd + "'; expected"));
    // The compiler is one text of CMake's, which is called again only where it has changed.
    fs::remove(checkout_ / "build/release.log");
    const std::map<std::string, std::string> built{{"CXX", odd}, {"HBR_ARCH", odd}};
    told("build", built);
    EXPECT_THAT(text_of(checkout_ / "build/release.log"),
                testing::AllOf(HasSubstr("<-DCMAKE_CXX_COMPILER=" + odd + ">"),
                               HasSubstr("<-DHBR_ARCH=" + odd + ">")));
    std::ofstream(checkout_ / "build/release/build.ninja") << "";
    fs::remove(checkout_ / "build/release.log");
    told("build", built);
    EXPECT_FALSE(fs::exists(checkout_ / "build/release.log")) << odd;
  }
  ::setenv("PATH", path.c_str(), 1);
}

// Some shells export the user's group so.
TEST_F(UserValues, AGroupOfTheEnvironmentIsNoneOfStages) {
  EXPECT_THAT(make("all", {{"GROUP", "users"}}, true).text, HasSubstr("<hbr><make><--group><0>"));
  EXPECT_THAT(make("all", {{"GROUP", "7"}}, false).text, HasSubstr("<hbr><make><--group><7>"));
}

// The folder may be there from a time when nothing could be fetched.
TEST_F(UserValues, ThreeIsFetchedForARobotUntilItIsThere) {
  program(checkout_ / "pipeline/fetch_three.sh", "echo fetches into $1; exit 2");
  fs::create_directories(checkout_ / ".cache/three");
  const ShellResult outcome = make("robot", {{"URDF", "a.urdf"}}, false);
  EXPECT_THAT(outcome.text, HasSubstr("fetches into .cache/three\n"));
  EXPECT_THAT(outcome.text, HasSubstr("<robot><a.urdf>"));
}

TEST_F(UserValues, OutFollowsTheProfilesName) {
  for (const auto& [profile, out] : {std::pair("paper", "out/paper"),
                                     {"my files/my own.toml", "out/my own"},
                                     {"folder/x", "out/x"},
                                     {"a.b.toml", "out/a.b"}})
    EXPECT_THAT(make("status", {{"PROFILE", profile}}, false).text,
                HasSubstr(std::string("<") + profile + "><--out><" + out + ">"));
  // Another make that a program starts has no OUT of this one's.
  EXPECT_THAT(make("status", {}, false).text, HasSubstr("<OUT=none>"));
  EXPECT_THAT(make("robot", {{"URDF", "a.urdf"}}, false).text, HasSubstr("<robot><a.urdf><out/robot><>"));
}

TEST_F(UserValues, WhatCanNotBeHandedOnIsRefusedInOneLine) {
  const auto refused = [&](const std::string& goal, const std::map<std::string, std::string>& values) {
    const ShellResult outcome = make(goal, values, false);
    EXPECT_EQ(std::ranges::count(outcome.text, '\n'), 1) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("  Stop.\n"));
    return outcome.text;
  };
  EXPECT_THAT(refused("status", {{"OUT", "-x"}}), HasSubstr("OUT is '-x': write ./-x"));
  EXPECT_THAT(refused("status", {{"OUT", "~/x"}}), HasSubstr("the shell did not replace the ~"));
  EXPECT_THAT(refused("status", {{"OUT", "a\nb"}}), HasSubstr("OUT has a line break in it"));
  EXPECT_THAT(refused("status", {{"LAUNCH", "a\nb"}}), HasSubstr("LAUNCH has a line break in it"));
  EXPECT_THAT(refused("install", {{"PREFIX", "~/x"}}), HasSubstr("PREFIX is '~/x': the shell did not"));
  EXPECT_THAT(refused("status", {{"OUT", ""}}), HasSubstr("OUT is empty"));
  EXPECT_THAT(refused("status", {{"PROFILE", ""}}), HasSubstr("PROFILE is empty: leave it out"));
  EXPECT_THAT(refused("build", {{"HBR_ARCH", ""}}), HasSubstr("HBR_ARCH is empty: leave it out"));
  EXPECT_THAT(refused("build", {{"UNITY", "no"}}), HasSubstr("UNITY is 'no'; expected 0 or 1"));
  EXPECT_THAT(refused("check-targets", {{"OBJECTS", "a\nb"}}), HasSubstr("OBJECTS has a line break in it"));
  EXPECT_THAT(refused("build", {{"BUILD", "a b"}}), HasSubstr("may have no space in its path"));
  EXPECT_THAT(refused("build", {{"BUILD", "a$b"}}), HasSubstr("may have no $ in its path"));
  for (const char* goal : {"\"a;b\"", "\"a:b\"", "\"a%b\"", "\"\\$(x)\"", "\"a b(\""})
    EXPECT_THAT(refused(goal, {}), HasSubstr("in its name"));
  for (const std::string goal : {"build/release/bin/hbr", "build/x", "/tmp/x", "out/reduced/layer1/00.h5"})
    EXPECT_THAT(refused(goal, {}), HasSubstr("'" + goal + "' is a path: goals are stages")) << goal;
  EXPECT_THAT(make("short/layer3", {}, false).text, HasSubstr("<short/layer3>"));  // a variation's stage
}

TEST_F(UserValues, AnUnwritableBuildIsUsedAsItIs) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  const ShellResult first = make("status", {}, false);
  ASSERT_THAT(first.text, HasSubstr("<hbr><status>"));
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
    fs::permissions(
        entry.path(),
        fs::perms::group_read | fs::perms::group_exec | fs::perms::others_read | fs::perms::others_exec,
        fs::perm_options::add);
  for (const char* goal : {"status", "audit", "verify", "all", "robot"}) {
    const ShellResult outcome = shell(
        "env -u OUT -u PROFILE -u BUILD -u DEPS setpriv --reuid=65534 --regid=65534 --clear-groups make -C " +
        checkout_.string() + " " + goal);
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("the programs in build are used as they are"));
    EXPECT_THAT(outcome.text, HasSubstr(goal == std::string("verify")  ? "<reference>"
                                        : goal == std::string("robot") ? "<robot>"
                                                                       : "<hbr>"));
  }
}

TEST_F(UserValues, TheRepositorysPathMayBeOdd) {
  set_up(folder_.path() / "it's a dol$lar, ünï (a=b) & 50%");
  const ShellResult outcome = make("status", {{"OUT", "o"}}, false);
  EXPECT_THAT(outcome.text, HasSubstr("<hbr><status><--profile><paper><--out><o>"));
  EXPECT_THAT(make("status", {{"OUT", "o"}}, false).text, testing::StartsWith("<hbr>"));  // configured once
  // Where CMake itself fails, one line says so.
  for (const char* letter : {";", "\"", "\\", "#"}) {
    set_up(folder_.path() / (std::string("a") + letter + "b"));
    const ShellResult refused = make("status", {}, false);
    EXPECT_THAT(refused.text, HasSubstr(std::string("there is a ") + letter + " in this path.  Stop.\n"));
    EXPECT_EQ(std::ranges::count(refused.text, '\n'), 1);
    EXPECT_THAT(make("help", {}, false).text, HasSubstr("make all"));
  }
}

}  // namespace
}  // namespace hbr
