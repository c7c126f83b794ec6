// The Makefile's own part of a build: what it configures, where, and when again. A stand-in for the project
// tells what CMake was given, and which sources it builds.
#include <gmock/gmock.h>

#include <cstdlib>
#include <set>

#include "tests/end_to_end/fake_folder.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class Makefile : public testing::Test {
 protected:
  const TemporaryFolder folder_;
  const fs::path checkout_ = folder_.path() / "checkout";

  void SetUp() override {
    ::unsetenv("CXXFLAGS");
    fs::create_directories(checkout_);
    fs::copy(HBR_SOURCE_DIR "/Makefile", checkout_);
    fs::copy(HBR_SOURCE_DIR "/.ci", checkout_ / ".ci");
    write(checkout_, "these sources");
    std::ofstream(checkout_ / "CMakeLists.txt")
        << "cmake_minimum_required(VERSION 3.25)\n"
           "project(stand_in LANGUAGES NONE)\n"
           "if(EXISTS ${CMAKE_SOURCE_DIR}/broken)\n"
           "  message(FATAL_ERROR \"it is broken\")\n"
           "endif()\n"
           "add_custom_target(programs COMMAND ${CMAKE_COMMAND} -E echo arch ${HBR_ARCH}, werror "
           "${HBR_WERROR},\n"
           "  compiler ${CMAKE_CXX_COMPILER} COMMAND ${CMAKE_COMMAND} -E cat "
           "${CMAKE_SOURCE_DIR}/sources.txt)\n";
  }
  static void write(const fs::path& checkout, const std::string& text) {
    std::ofstream(checkout / "sources.txt") << text << '\n';
  }
  static std::string command(const fs::path& checkout, const std::string& words) {
    return "env -u BUILD -u HBR_ARCH -u WERROR -u CXX make -C " + checkout.string() + " DEPS=none " + words;
  }
  static ShellResult make(const fs::path& checkout, const std::string& words) {
    return shell(command(checkout, words));
  }
  ShellResult make(const std::string& words) { return make(checkout_, words); }
  // Once more with the same words: nothing is configured.
  void expect_kept(const std::string& words) {
    EXPECT_THAT(make("-n " + words).text, Not(HasSubstr("--fresh"))) << words;
  }
};

TEST_F(Makefile, WarningsStopNoUser) {
  const ShellResult outcome = make("build");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("arch native, werror OFF,"));
  expect_kept("build");
}

TEST_F(Makefile, ChangedSettingsReachCMake) {
  for (const auto& [words, told] :
       {std::pair{"build", "arch native, werror OFF"}, std::pair{"build WERROR=1", "arch native, werror ON"},
        std::pair{"build WERROR=0", "arch native, werror OFF"},
        std::pair{"build HBR_ARCH=x86-64-v3", "arch x86-64-v3, werror OFF"},
        std::pair{"build CXX=some++", "werror OFF, compiler some++"}}) {
    EXPECT_THAT(make(words).text, HasSubstr(told));
    expect_kept(words);
  }
}

// They reach the compiler by way of CMake, which reads them once.
TEST_F(Makefile, ChangedFlagsOfTheEnvironmentReachCMake) {
  make("build");
  for (const char* flags : {"-O1 -DX=1", ""}) {
    ::setenv("CXXFLAGS", flags, 1);
    EXPECT_THAT(make("-n build").text, HasSubstr("--fresh")) << flags;
    EXPECT_EQ(make("build").code, 0);
    expect_kept("build");
  }
  ::unsetenv("CXXFLAGS");
}

TEST_F(Makefile, WhatCouldNotBeConfiguredIsConfiguredAgain) {
  make("build");
  std::ofstream(checkout_ / "broken") << "";
  const ShellResult broken = make("build HBR_ARCH=x86-64-v3");
  EXPECT_EQ(broken.code, 2);
  EXPECT_THAT(broken.text, HasSubstr("it is broken"));
  EXPECT_THAT(make("-n build").text, HasSubstr("--fresh"));
  fs::remove(checkout_ / "broken");
  EXPECT_THAT(make("build").text, HasSubstr("arch native,"));
  expect_kept("build");
}

TEST_F(Makefile, PackagesThatNobodyLookedAtAreLookedAtLater) {
  std::ofstream(checkout_ / ".ci/packages") << "#!/bin/bash\necho packages: $1\n";
  EXPECT_THAT(make("build").text, HasSubstr("packages: none"));
  expect_kept("build");
  EXPECT_THAT(make("build DEPS=auto").text, HasSubstr("packages: auto"));
  expect_kept("build");
  EXPECT_THAT(make("build DEPS=auto").text, Not(HasSubstr("packages")));
}

TEST_F(Makefile, BuildsInOneFolderWaitForEachOther) {
  std::ofstream(checkout_ / "CMakeLists.txt", std::ios::app)
      << "add_custom_target(alone COMMAND mkdir busy COMMAND sleep 1 COMMAND rmdir busy)\n"
         "add_dependencies(programs alone)\n";
  const std::string one = command(checkout_, "build");
  const ShellResult two = shell(one + " & " + one + " && wait $! && echo both are built");
  EXPECT_THAT(two.text, HasSubstr("both are built"));
  const std::string lock = (checkout_ / "build/.lock").string(), held = (folder_.path() / "held").string();
  const ShellResult waited = shell("flock " + lock + " bash -c \"touch " + held +
                                   "; sleep 3\" & until [ -e " + held + " ]; do sleep 0.01; done; " + one);
  EXPECT_EQ(waited.code, 0) << waited.text;
  EXPECT_THAT(waited.text, HasSubstr("waiting for another build in build\n"));
}

TEST_F(Makefile, AVariableThatItDoesNotHeedIsRefused) {
  for (const char* words : {"build PROFIL=reduced", "help THREDS=2", "all CFLAGS=-O0"}) {
    const ShellResult outcome = make(words);
    EXPECT_EQ(outcome.code, 2) << words;
    const std::string name = std::string(words).substr(0, std::string(words).find('='));
    EXPECT_THAT(outcome.text, HasSubstr("there is no variable '" + name.substr(name.find(' ') + 1) +
                                        "'; there are PROFILE"));
    EXPECT_THAT(outcome.text, Not(HasSubstr("arch native")));
  }
}

// What is heeded in the environment alone is not said to be unknown.
TEST_F(Makefile, FlagsOnItsCommandLineAreToldWhereTheyBelong) {
  for (const std::string name : {"CXXFLAGS", "LDFLAGS"}) {
    const ShellResult outcome = make("build " + name + "=-O2");
    EXPECT_EQ(outcome.code, 2) << outcome.text;
    EXPECT_THAT(outcome.text,
                HasSubstr(name + " is heeded where it is in the environment; write it before make: " + name +
                          "=\'-O2\' make"));
  }
}

TEST_F(Makefile, AMovedOrCopiedCheckoutBuildsItsOwnSources) {
  make("build");
  const fs::path copy = folder_.path() / "copy", moved = folder_.path() / "moved";
  fs::copy(checkout_, copy, fs::copy_options::recursive);
  write(copy, "the copy's sources");
  EXPECT_THAT(make(copy, "build").text, HasSubstr("the copy's sources"));
  fs::rename(copy, moved);
  write(moved, "the moved sources");
  const ShellResult outcome = make(moved, "build");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("the moved sources"));
}

TEST_F(Makefile, ABuildElsewhereLeavesTheSourcesAlone) {
  const auto files = [&] {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(checkout_)) names.insert(entry.path());
    return names;
  };
  const auto before = files();
  const std::string build = "build BUILD=" + (folder_.path() / "elsewhere").string();
  EXPECT_THAT(make(build).text, HasSubstr("these sources"));
  EXPECT_EQ(files(), before);
  expect_kept(build);
  // Two checkouts that share it get their own sources each.
  const fs::path copy = folder_.path() / "copy";
  fs::copy(checkout_, copy, fs::copy_options::recursive);
  write(copy, "the copy's sources");
  EXPECT_THAT(make(copy, build).text, HasSubstr("the copy's sources"));
  EXPECT_THAT(make(build).text, HasSubstr("these sources"));
}

TEST_F(Makefile, ABuildFolderThatCannotBeWrittenIsTold) {
  const ShellResult outcome = make("build BUILD=/proc/hbr");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("can't write to /proc/hbr: name a folder for the programs with BUILD"));
}

// Where a file system has no locks a script goes on to fetch.
TEST(FetchScripts, GoOnWithoutLocks) {
  const TemporaryFolder folder;
  const fs::path bin = folder.path() / "bin";
  fs::create_directories(bin);
  for (const auto& [name, text] :
       {std::pair{"flock", "exit 71"}, {"curl", "exit 7"}, {"npm", "echo offline; exit 1"}}) {
    std::ofstream(bin / name) << "#!/bin/sh\n" << text << '\n';
    fs::permissions(bin / name, fs::perms::owner_all);
  }
  const ShellResult outcome =
      shell("PATH=" + bin.string() + ":$PATH bash " HBR_SOURCE_DIR "/pipeline/fetch_three.sh " +
            (folder.path() / "three").string());
  EXPECT_EQ(outcome.code, 2);
  EXPECT_THAT(outcome.text, HasSubstr("neither the mirrors nor npm have it (offline)"));
}

TEST(FetchScripts, TellAFolderThatCannotBeWrittenAndWhatToDo) {
  const ShellResult outcome = shell("bash " HBR_SOURCE_DIR "/pipeline/fetch_three.sh /proc/three");
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.text,
            "three.js: can\'t write to /proc/three: let someone who can call "
            "pipeline/fetch_three.sh /proc/three, or do with pictures\n");
}

}  // namespace
}  // namespace hbr
