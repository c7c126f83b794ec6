// Failed stages are tried again, launchers are told what they may ask for, short stages share a launch.
#include <gmock/gmock.h>

#include "tests/end_to_end/launcher.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

int count(const std::string& text, const std::string& word) {
  int found = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; ++at) ++found;
  return found;
}

// What the launcher does until it has been called so often; then it launches.
std::string at_first(int times, const std::string& script) {
  return "cd \"$(dirname \"$0\")\"; echo x >>calls; [ $(wc -l <calls) -gt " + std::to_string(times) +
         " ] || { " + script + "; }; exec \"$@\"";
}

TEST(Retry, GoesOnUntilItIsMadeAndSaysWhy) {
  const std::map<std::string, std::string> reasons{
      {"exit 7", "fake_stage did not come to its end: LAUNCH="},
      {"exit 2", "gave exit code 2"},
      {"exit 137", "gave exit code 137, as of a signal: Killed"},
      {"kill -9 $$", "fake_stage was ended by a signal: Killed"},
      {"kill -ILL $$", "Illegal instruction; built for another processor: build it there, or with HBR_ARCH="},
      {"exit 132", "as of a signal: Illegal instruction; built for another processor"},
      {"exit 0", "fake_stage succeeded, but left no record of its run"},
      {"\"$@\"; while [ \"$1\" != --output ]; do shift; done; rm \"$2\"; exit 0",
       "fake_stage succeeded, but left nothing at"}};
  for (const auto& [script, reason] : reasons) {
    FakeFolder folder("retry");
    const ShellResult outcome = folder.make(launcher(folder, at_first(2, script)) + " --retry 2 base");
    EXPECT_EQ(outcome.code, 0) << outcome.text;
    EXPECT_EQ(count(outcome.text, "base: fake_stage "), 2) << outcome.text;
    EXPECT_THAT(outcome.text, HasSubstr("; try 3 of 3\n"));
    const nlohmann::json run = run_facts(folder, "base");
    EXPECT_EQ(run.at("tries"), 3);
    ASSERT_EQ(run.at("failures").size(), 2u);
    EXPECT_THAT(run.at("failures")[0], HasSubstr(reason));
    EXPECT_EQ(folder.artifacts().size(), 1u);  // and no temporaries

    fs::remove(folder.path / "calls");
    folder.profile.base.number = 7;
    const ShellResult last = folder.make(launcher(folder, at_first(2, script)) + " --retry 1 base");
    EXPECT_NE(last.code, 0);
    EXPECT_THAT(last.text, HasSubstr("(try 2 of 2)"));
  }
}

TEST(Retry, IsNotForWhatCannotBecomeRight) {
  FakeFolder folder("refused");
  folder.profile.base.behaviour = "refuses";
  for (const std::string& launch : {std::string(), launcher(folder, "\"$@\"")}) {
    const ShellResult refused = folder.make(launch + " --retry 3 base");
    EXPECT_NE(refused.code, 0);
    EXPECT_EQ(count(refused.text, "the fake input is wrong"), 1) << refused.text;
    EXPECT_THAT(refused.text, Not(HasSubstr("try ")));
  }
  const ShellResult none = folder.make("--launch \"nosuch -n1\" --retry 3 base");
  EXPECT_NE(none.code, 0);
  EXPECT_THAT(none.text, HasSubstr("hbr: LAUNCH=" +
                                   std::string("\x27nosuch -n1\x27: no such command (exit code 127): its "
                                               "first word must be a command on this machine\x27s PATH")));
  EXPECT_THAT(none.text, Not(HasSubstr("try ")));
  folder.profile.base.behaviour = "crashes";
  const ShellResult crashed = folder.make("--retry 3 base");
  EXPECT_EQ(count(crashed.text, "fake_stage was ended by a signal: Aborted"), 4) << crashed.text;
}

TEST(Retry, IsNotForWhoWantsItToEnd) {
  FakeFolder folder("stopped");
  const std::string ready = (folder.path / "ready").string();
  const std::string launch = launcher(folder, "touch " + ready + "; exec sleep 60");
  for (const char* signal : {"HUP", "TERM"}) {
    fs::remove(ready);
    // To the runner, as a terminal would; make waits for it.
    const ShellResult outcome =
        shell(folder.command("make", launch + " --retry 5 base") + " & until [ -e " + ready +
              " ]; do sleep 0.01; done; for p in $(cat /proc/$!/task/$!/children); do tr \"\\0\" \" \" "
              "</proc/$p/cmdline | "
              "grep -q \" run \" && "
              "kill -" +
              std::string(signal) + " $p; done; wait $!; echo code $?");
    EXPECT_THAT(outcome.text, HasSubstr("base: fake_stage was ended by a signal"));
    EXPECT_THAT(outcome.text, Not(HasSubstr("try 2")));
    EXPECT_THAT(outcome.text, Not(HasSubstr("code 0")));
  }
}

TEST(LaunchVariables, TellTheJobAndWhatItMayNeed) {
  FakeFolder folder("variables");
  const std::string told = (folder.path / "told").string();
  const std::string launch = launcher(folder, "echo \"$1 $HBR_MEMORY_MB\" >>" + told +
                                                  "; shift; [ ! -e fail ] || exit 1; exec \"$@\"") +
                             "\" \\$HBR_JOB,\\$HBR_THREADS,\\$HBR_SECONDS\"";
  const auto lines = [&] { return shell("sort " + told + "; rm " + told).text; };
  ASSERT_EQ(folder.make(launch + " --threads 3 layer_b").code, 0);
  EXPECT_THAT(lines(),
              testing::StartsWith("base,3,21600 4000\nlayer_a/00,3,21600 4000\nlayer_a/01,3,21600 4000\n"
                                  "layer_b/00,3,21600 4000\nlayer_b/01,3,121 "));  // by then one is known
  // Without a number of threads it is one that is asked for.
  std::ofstream(folder.out() / "layer_b/00.h5") << "x";
  folder.profile.replications = 1;
  ASSERT_EQ(folder.make(launch + " layer_b").code, 0);
  const auto of = [&](const char* key) {
    return std::max(run_facts(folder, "layer_b/00").at(key).get<double>(),
                    run_facts(folder, "layer_b/01").at(key).get<double>());
  };
  std::string job, memory;
  std::istringstream(lines()) >> job >> memory;
  EXPECT_EQ(job, "layer_b/00,1,121");
  EXPECT_GE(std::stod(memory), 200 + 1.2 * of("peak_memory_bytes") / 1048576);
  EXPECT_LE(std::stod(memory), 400);
}

TEST(LaunchVariables, HaveOneDollar) {
  FakeFolder folder("dollars");
  const ShellResult two = folder.make("--launch \"env A=\\$\\$HBR_JOB\" base");
  EXPECT_EQ(two.code, 2);
  EXPECT_THAT(two.text, HasSubstr("write one $ before a variable\x27s name"));
  EXPECT_EQ(folder.make("--launch \"env A=\\$HBR_JOB\" base").code, 0);
}

TEST(Groups, AreLaunchedOnceAndLeaveTheSameBytes) {
  FakeFolder folder("groups");
  const std::string calls = (folder.path / "calls").string();
  const std::string launch = launcher(folder, "echo $HBR_JOB >>" + calls + "; exec \"$@\"") + " --group 1000";
  const auto jobs = [&] { return shell("sort " + calls + " | tr \"\\n\" \" \"; rm " + calls).text; };
  ASSERT_EQ(folder.make(launch).code, 0);
  EXPECT_EQ(jobs(), "base layer_a/00 layer_a/01 layer_b/00 layer_b/01 pages sum ");  // nothing is known yet
  const auto artifacts = folder.artifacts();
  shell("rm " + folder.out().string() + "/*.h5 " + folder.out().string() + "/*/*.h5");
  const ShellResult outcome = shell("MAKEFLAGS=-j4 " + folder.command("make", launch));
  EXPECT_EQ(outcome.code, 0) << outcome.text;
  EXPECT_THAT(outcome.text, HasSubstr("7 of 7 artifacts to make in 4 launches"));
  EXPECT_EQ(jobs(), "base layer_a/00+1 layer_a/01+1 sum+1 ");
  EXPECT_TRUE(folder.artifacts() == artifacts);
  EXPECT_EQ(shell(folder.command("audit")).code, 0);
  for (const char* name : {"layer_a/00", "layer_b/00", "sum", "pages"}) {
    EXPECT_THAT(run_facts(folder, name).at("launch"), HasSubstr("launcher")) << name;
    EXPECT_EQ(run_facts(folder, name).at("tries"), 1) << name;
  }
  EXPECT_EQ(made(folder.make()), "");
}

TEST(Groups, FailAndAreTriedAgainStageByStage) {
  FakeFolder folder("failing_groups");
  folder.profile.replications = 1;
  ASSERT_EQ(folder.make("layer").code, 0);
  const std::string remove = "rm " + folder.out().string() + "/layer_*/00.h5";
  shell(remove);
  // The job is lost.
  const std::string again = " --group 1000 --retry 2 layer";
  const ShellResult lost = folder.make(launcher(folder, at_first(1, "exit 9")) + again);
  EXPECT_EQ(lost.code, 0) << lost.text;
  EXPECT_EQ(made(lost), "layer_a/00 layer_b/00");
  EXPECT_THAT(lost.text, HasSubstr("layer_a/00+1: hbr did not come to its end: LAUNCH="));
  for (const char* name : {"layer_a/00", "layer_b/00"}) {
    EXPECT_EQ(run_facts(folder, name).at("tries"), 2) << name;
    EXPECT_THAT(run_facts(folder, name).at("failures")[0], HasSubstr("gave exit code 9")) << name;
  }
  // Its second stage refuses or crashes: the first is made, and the rest told as of any stage.
  const std::map<std::string, int> lines{{"refuses", 1}, {"crashes", 3}};
  for (const auto& [behaviour, times] : lines) {
    shell(remove);
    folder.profile.layer_b.behaviour = behaviour;
    folder.make();  // so that it is known how long it takes
    shell("rm " + folder.out().string() + "/layer_a/00.h5");
    const ShellResult outcome = folder.make(launcher(folder, "exec \"$@\"") + again);
    EXPECT_NE(outcome.code, 0);
    EXPECT_EQ(made(outcome), "layer_a/00") << outcome.text;
    EXPECT_EQ(count(outcome.text, "layer_b/00: fake_stage was ended by a signal") +
                  count(outcome.text, "layer_b/00: the fake input is wrong"),
              times)
        << outcome.text;
  }
}

TEST(Groups, GoOnWithWhatDoesNotNeedTheFailedOne) {
  FakeFolder folder("going_on");
  ASSERT_EQ(folder.make().code, 0);
  const std::string out = folder.out().string();
  shell("cd " + out + "; rm layer_a/00.h5 layer_b/*.h5");
  const ShellResult outcome = shell(folder.tool() + " run --out " + out +
                                    " layer_b/00.h5 layer_b/01.h5");  // the first lacks its input
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(made(outcome), "layer_b/01");
}

// Before they begin, or while they run.
TEST(Groups, EndWhereTheMakeThatWantedThemHasEnded) {
  FakeFolder folder("orphans");
  folder.profile.layer_a.steps = 300;
  ASSERT_EQ(folder.make().code, 0);
  const std::string out = folder.out().string(), claim = out + "/.plan/claim";
  shell("rm " + out + "/layer_?/*.h5");
  const std::string take = "printf 7.8@node9 >" + claim,
                    begun = "compgen -G \"" + out + "/layer_a/.checkpoint-*\" >/dev/null";
  for (const std::string& meanwhile :
       {take + "; ", "(for i in {1..500}; do " + begun + " && break; sleep 0.01; done; " + take + ") & "}) {
    const ShellResult orphan =
        folder.make(launcher(folder, meanwhile + "\"$@\"; code=$?; rm " + claim + "; exit $code") +
                    " --group 1000 layer");
    EXPECT_NE(orphan.code, 0);
    EXPECT_THAT(orphan.text, HasSubstr("layer_a/00: the make that wanted this has ended"));
    EXPECT_EQ(made(orphan), "");
  }
}

}  // namespace
}  // namespace hbr
