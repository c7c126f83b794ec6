// What the runner promises, tried with fake stages through the tool and a real make.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <csignal>

#include "pipeline/artifact/manifest.h"
#include "pipeline/core/sanitizers.h"
#include "tests/end_to_end/launcher.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const std::string kEverything = "base layer_a/00 layer_a/01 layer_b/00 layer_b/01 pages sum";

TEST(Runner, MakesWhatIsMissingAndThenHasNothingToDo) {
  FakeFolder folder("nothing");
  const ShellResult first = folder.make();
  EXPECT_EQ(first.code, 0) << first.text;
  EXPECT_EQ(made(first), kEverything);
  const ShellResult second = folder.make();
  EXPECT_EQ(second.code, 0);
  EXPECT_THAT(second.text, HasSubstr("nothing to do, 7 artifacts are as they should be"));
  // Time stamps do not matter, nor does a folder that was moved.
  shell("find " + folder.out().string() + " -type f -exec touch {} +");
  EXPECT_EQ(made(folder.make()), "");
  const auto artifacts = folder.artifacts();
  fs::rename(folder.out(), folder.path / "elsewhere");
  EXPECT_EQ(made(shell(folder.command_at(folder.path / "elsewhere", "make"))), "");
  EXPECT_EQ(shell(folder.command_at(folder.path / "elsewhere", "audit")).code, 0);
  // Side by side, other threads, another folder: the same bytes.
  EXPECT_EQ(shell("MAKEFLAGS=-j4 " + folder.command("make", "--threads 3")).code, 0);
  EXPECT_TRUE(folder.artifacts() == artifacts);
}

TEST(Runner, AChangedSettingRerunsItsStageAndWhatDependsOnIt) {
  FakeFolder folder("setting");
  folder.make();
  folder.profile.layer_b.number = 5;
  const std::string status = folder.status().text;
  EXPECT_THAT(status, HasSubstr("stage    fresh  stale  missing  why\n"));
  EXPECT_THAT(status, HasSubstr("layer_a      2      0        0\n"));
  EXPECT_THAT(status, HasSubstr("layer_b      0      2        0  0-1: settings.number 3.0 -> 5.0\n"));
  EXPECT_EQ(made(folder.make()), "layer_b/00 layer_b/01 pages sum");
  // Another slice, the same bytes: what depends on them is left alone.
  folder.profile.layer_b.steps = 1;
  EXPECT_EQ(made(folder.make()), "layer_b/00 layer_b/01");
  EXPECT_EQ(made(folder.make()), "");
}

TEST(Runner, MoreReplicationsRunOnlyThose) {
  FakeFolder folder("replications");
  folder.make();
  folder.profile.replications = 4;
  EXPECT_EQ(made(folder.make()), "layer_a/02 layer_a/03 layer_b/02 layer_b/03 pages sum");
}

TEST(Runner, SourcesCountByContent) {
  FakeFolder folder("sources");
  const fs::path source = folder.path / "robot.urdf";
  folder.profile.sources = {source.string()};
  const ShellResult missing = folder.make();
  EXPECT_NE(missing.code, 0);
  EXPECT_THAT(missing.text, HasSubstr("base: the file " + source.string() + ", which it reads, is missing"));
  EXPECT_THAT(folder.status().text, HasSubstr("robot.urdf, which it reads, is missing"));
  std::ofstream(source) << "a";
  EXPECT_EQ(made(folder.make()), kEverything);
  std::ofstream(source) << "a";
  EXPECT_EQ(made(folder.make()), "");
  std::ofstream(source) << "b";
  EXPECT_THAT(folder.status().text, HasSubstr("robot.urdf changed"));
  EXPECT_EQ(made(folder.make()), "base");  // a fake stage's result does not depend on it
}

TEST(Runner, StagesFamiliesAndReplicationsByName) {
  FakeFolder folder("goals");
  EXPECT_EQ(made(folder.make("--replication 1 layer_b")), "base layer_a/01 layer_b/01");
  EXPECT_EQ(made(folder.make("layer")), "layer_a/00 layer_b/00");
  EXPECT_THAT(
      folder.make("layr_a").text,
      HasSubstr(
          "no stage 'layr_a' (did you mean 'layer_a'?); `make status` lists all; the stages and families "
          "are: base, layer_a, layer_b, sum, pages\n"));
  EXPECT_EQ(folder.make("layr_a").code, 2);
  EXPECT_THAT(folder.make("layr").text, HasSubstr("(did you mean 'layer'?)"));
  EXPECT_THAT(folder.make("--replication 2 layer_a").text,
              HasSubstr("no replication 2: they go from 0 to 1"));
}

TEST(Runner, NumbersThatAreNoneAreToldByTheNameThatUsersGive) {
  FakeFolder folder("numbers");
  for (const auto& [option, told] :
       {std::pair{"--replication x", "REP is 'x': expected a whole number from 0 to 9999 ("},
        {"--replication -1", "REP is '-1': expected"},
        {"--replication 1.5", "REP is '1.5': expected"},
        {"--threads 5000", "THREADS is '5000': expected a whole number from 0 to 4096 ("},
        {"--retry many", "RETRY is 'many': expected a whole number from 0 to 100 ("},
        {"--group soon", "GROUP is 'soon': expected a number from 0 to 1000000000 ("}}) {
    const ShellResult outcome = folder.make(option);
    EXPECT_EQ(outcome.code, 2) << option;
    EXPECT_THAT(outcome.text, HasSubstr(told));
    EXPECT_EQ(std::ranges::count(outcome.text, '\n'), 1) << outcome.text;
  }
}

TEST(Runner, TellsHowFarTheWholeMakeIs) {
  FakeFolder folder("tally");
  const std::string text = folder.make().text;
  EXPECT_THAT(text, HasSubstr("base: made in"));
  EXPECT_THAT(text, HasSubstr("; 1 of 7"));
  EXPECT_THAT(text, HasSubstr("; 7 of 7\n"));
  EXPECT_THAT(text, HasSubstr("stopped at any time, the same command goes on"));
}

TEST(Runner, PlanTellsTheTruthAndWritesNothing) {
  FakeFolder folder("plan");
  const ShellResult before = shell(folder.command("plan"));
  EXPECT_EQ(before.code, 0);
  EXPECT_THAT(before.text, HasSubstr("fake_stage --root"));
  EXPECT_FALSE(fs::exists(folder.out()));
  folder.make();
  EXPECT_THAT(shell(folder.command("plan")).text, HasSubstr("nothing to do"));
  folder.profile.sum.number = 9;
  const std::string after = shell(folder.command("plan")).text;
  EXPECT_EQ(std::count(after.begin(), after.end(), '\n'), 2) << after;  // sum, and perhaps pages
  EXPECT_THAT(after, HasSubstr("# if its inputs become others"));
}

TEST(Runner, ADamagedArtifactIsToldAndMadeAgain) {
  FakeFolder folder("damage");
  folder.make();
  const auto artifacts = folder.artifacts();
  std::ofstream(folder.out() / "layer_a/00.h5", std::ios::app) << "x";
  std::ofstream(folder.out() / "pages/extra.txt") << "x";
  const ShellResult audit = shell(folder.command("audit"));
  EXPECT_EQ(audit.code, 1);
  EXPECT_THAT(audit.text, HasSubstr("layer_a/00.h5: damaged: expected sha256"));
  EXPECT_THAT(audit.text, HasSubstr("7 artifacts read again"));
  EXPECT_THAT(audit.text, HasSubstr("2 not as they should be"));
  const ShellResult again = folder.make();
  EXPECT_THAT(again.text, HasSubstr("layer_a/00.h5: damaged"));
  EXPECT_EQ(made(again), "layer_a/00 pages");
  EXPECT_TRUE(folder.artifacts() == artifacts);
  std::ofstream(folder.out() / "sum.json") << "{";
  EXPECT_EQ(made(folder.make()), "sum");
}

TEST(Runner, AnAuditOfNothingIsNoSuccess) {
  FakeFolder folder("nothing_to_audit");
  const ShellResult audit = shell(folder.command("audit"));
  EXPECT_EQ(audit.code, 1);
  EXPECT_THAT(audit.text, HasSubstr(": 0 artifacts read again (0.0 MB), 7 missing, 0 not as they should be; "
                                    "is this OUT a folder of this PROFILE"));
}

TEST(Runner, WhatKilledPlansLeftGoes) {
  FakeFolder folder("slices");
  folder.make();
  const fs::path left = folder.out() / ".plan/slices/layer_a/.tmp-77-00.json";
  std::ofstream(left) << "x";
  EXPECT_EQ(made(folder.make()), "");
  EXPECT_FALSE(fs::exists(left));
}

TEST(Runner, OtherBytesOfTheSameIngredientsAreTold) {
  FakeFolder folder("reproducible");
  folder.make();
  const fs::path artifact = folder.out() / "base.h5", manifest = folder.out() / "base.json";
  Manifest before = read_manifest(manifest);
  before.content.sha256 = sha256_of_text("other bytes");
  write_manifest(manifest, before);
  fs::remove(artifact);
  const ShellResult other = folder.make();
  EXPECT_EQ(other.code, 0);
  const char* told = "base: not reproducible: the same ingredients gave other bytes than before\n";
  EXPECT_THAT(other.text, HasSubstr(told));
  // The same bytes are nothing to tell, nor are other ones of other ingredients.
  fs::remove(artifact);
  const ShellResult same = folder.make();
  EXPECT_EQ(made(same), "base");
  EXPECT_THAT(same.text, Not(HasSubstr("not reproducible")));
  folder.profile.base.number = 5;
  EXPECT_THAT(folder.make().text, Not(HasSubstr("not reproducible")));
}

TEST(Runner, AFailingStageLeavesNothing) {
  const std::map<std::string, std::string> told{
      {"refuses", "layer_a/00: layer_a/00: the fake input is wrong"},
      {"leaves nothing", "succeeded, but left nothing at"},
      {"crashes", "fake_stage was ended by a signal: Aborted"}};
  for (const auto& [behaviour, text] : told) {
    FakeFolder folder("failing");
    folder.profile.layer_a.behaviour = behaviour;
    const ShellResult outcome = folder.make();
    EXPECT_NE(outcome.code, 0);
    EXPECT_THAT(outcome.text, HasSubstr(text));
    EXPECT_EQ(folder.artifacts().size(), 1u);  // base
    folder.profile.layer_a.behaviour = "works";
    EXPECT_EQ(folder.make().code, 0);
  }
}

TEST(Runner, LaunchWordsStandBeforeEveryStage) {
  FakeFolder folder("launch");
  const fs::path seen = folder.path / "seen";
  const ShellResult outcome = folder.make(
      launcher(folder, "echo $1 $2 >>" + seen.string() + "; shift 2; exec \"$@\"") + "\" two words\" base");
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_EQ(made(outcome), "base");
  EXPECT_EQ(read_whole(seen), "two words\n");
  EXPECT_EQ(made(folder.make("--threads 1 base")), "");  // neither is part of the key
  folder.profile.base.number = 7;
  EXPECT_NE(folder.make("--launch no-such-launcher base").code, 0);
}

TEST(Runner, BadFoldersAndFullDisksAreOneClearLine) {
  FakeFolder folder("places");
  std::ofstream(folder.path / "file") << "x";
  const ShellResult below = shell(folder.command_at(folder.path / "file/out", "make"));
  EXPECT_EQ(below.code, 2);
  EXPECT_EQ(
      below.text,
      "hbr: " + (folder.path / "file/out").string() + ": can" +
          "'t make this output folder: Not a directory; something above it is no folder: remove that, or "
          "use another place\n");
  EXPECT_EQ(shell(folder.command_at("/proc/hbr", "make")).code, 2);

#if !HBR_THREAD_SANITIZER  // its own memory is a file, which such a limit cuts
  folder.profile.layer_a.size = 100'000;
  const ShellResult full = shell("ulimit -f 200; " + folder.command("make"));
  EXPECT_NE(full.code, 0);
  EXPECT_THAT(full.text, HasSubstr("layer_a/00: "));
  EXPECT_THAT(full.text, HasSubstr("File too large"));
  EXPECT_EQ(folder.artifacts().size(), 1u);  // base, and no temporary file
  EXPECT_EQ(folder.make().code, 0);
#endif
}

TEST(Runner, ASecondMakeIsToldSo) {
  FakeFolder folder("second");
  folder.profile.base.steps = 1500;
  const ShellResult both =
      shell(folder.command("make") + " & sleep 0.3; " + folder.command("make") + "; echo code $?; kill %1");
  EXPECT_THAT(both.text, HasSubstr("another make (process "));
  EXPECT_THAT(both.text, HasSubstr("is at work in this folder"));
  EXPECT_THAT(both.text, HasSubstr("code 2"));
}

}  // namespace
}  // namespace hbr
