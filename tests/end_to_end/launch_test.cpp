// Stages that another program launches: what is recorded of them, and what changes while they wait.
#include <gmock/gmock.h>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/manifest.h"
#include "pipeline/process/identity.h"
#include "tests/end_to_end/launcher.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// A server runs what the launcher only hands on, as on a cluster.
TEST(Launch, RecordsAreTheProgramsNotTheLaunchers) {
  FakeFolder folder("records");
  folder.profile.base.size = 8'000'000;  // 64 MB
  folder.profile.base.steps = 50;
  const std::string elsewhere = "elsewhere", path = folder.path.string();
  const bool root = shell("unshare --uts hostname " + elsewhere).code == 0;
  std::ofstream(folder.path / "server")
      << (root ? "hostname " + elsewhere + "\n" : "") << "mkfifo ask answer; touch ready\n"
      << "while mapfile -d \"\" words <ask; do \"${words[@]}\"; echo $? >answer; done\n";
  const ShellResult outcome = shell(
      "cd " + path + "; " + (root ? "unshare --uts " : "") + "bash server & until [ -e " + path +
      "/ready ]; do sleep 0.01; done; " +
      folder.command("make", launcher(folder, "cd " + path +
                                                  "; sleep 0.3; printf \"%s\\0\" \"$@\" >ask; read code "
                                                  "<answer; exit $code") +
                                 " --threads 3 base") +
      "; code=$?; kill %1; exit $code");
  ASSERT_EQ(outcome.code, 0) << outcome.text;
  const nlohmann::json run = run_facts(folder, "base");
  EXPECT_GE(run.at("peak_memory_bytes"), 64e6);  // the shell that launched it has 4e6
  EXPECT_GT(run.at("cpu_seconds"), 0);
  EXPECT_GE(run.at("seconds"), 0.1);
  EXPECT_GE(run.at("waited_seconds"), 0.3);
  EXPECT_EQ(run.at("host"), root ? elsewhere : this_host());
  EXPECT_EQ(run.at("threads"), 3);
  EXPECT_TRUE(run.contains("processor"));
}

TEST(Launch, AStageWithoutARecordHasFailed) {
  FakeFolder folder("record");
  const std::string find = "\"$@\"; while [ \"$1\" != --record ]; do shift; done; ";
  const ShellResult none = folder.make(launcher(folder, find + "rm \"$2\"") + " base");
  EXPECT_NE(none.code, 0);
  EXPECT_THAT(none.text, HasSubstr("base: fake_stage succeeded, but left no record of its run"));
  EXPECT_EQ(folder.artifacts().size(), 0u);
  const ShellResult odd = folder.make(launcher(folder, find + "echo {} >\"$2\"") + " base");
  EXPECT_NE(odd.code, 0);
  EXPECT_THAT(odd.text, HasSubstr("missing key 'exit'"));
  EXPECT_EQ(folder.artifacts().size(), 0u);
}

TEST(Launch, AProgramBuiltAnewWhileItWaitsIsNotTakenForTheOldOne) {
  FakeFolder folder("rebuilt");
  const fs::path programs = folder.path / "programs", program = programs / "fake_stage";
  fs::create_directories(programs);
  fs::copy(folder.programs / "fake_stage", program);
  const std::string old_hash = sha256_of_program(program),
                    with = "--programs " + programs.string() + " base ";
  const ShellResult rebuilt =
      folder.make(with + launcher(folder, "LC_ALL=C sed -i \"s/A stage for tests/B stage for tests/\" " +
                                              program.string() + "; \"$@\""));
  EXPECT_NE(rebuilt.code, 0);
  EXPECT_THAT(rebuilt.text, HasSubstr("base: " + program.string() + ": this program was built anew"));
  EXPECT_EQ(folder.artifacts().size(), 0u);
  EXPECT_EQ(made(folder.make(with)), "base");
  const std::string recorded = read_manifest(folder.out() / "base.json").made_from.program;
  EXPECT_EQ(recorded, sha256_of_program(program));
  EXPECT_NE(recorded, old_hash);
}

TEST(Launch, WhatAStageReadsMayNotChangeMeanwhile) {
  FakeFolder folder("changed");
  const fs::path source = folder.path / "robot.urdf";
  folder.profile.sources = {source.string()};
  std::ofstream(source) << "a";
  const ShellResult changed =
      folder.make(launcher(folder, "echo b >>" + source.string() + "; \"$@\"") + " base");
  EXPECT_NE(changed.code, 0);
  EXPECT_THAT(changed.text, HasSubstr("base: the file " + source.string() + " was changed while this ran"));
  EXPECT_EQ(folder.artifacts().size(), 0u);
  EXPECT_EQ(made(folder.make("base")), "base");

  const std::string base = (folder.out() / "base.h5").string();
  const ShellResult input = folder.make(
      "layer_a --replication 0 " + launcher(folder, "\"$@\"; code=$?; echo x >>" + base + "; exit $code"));
  EXPECT_NE(input.code, 0);
  EXPECT_THAT(input.text, HasSubstr("layer_a/00: its input " + base +
                                    " is missing or damaged: give the same make again"));
  EXPECT_EQ(made(folder.make("layer_a --replication 0")), "base layer_a/00");
}

}  // namespace
}  // namespace hbr
