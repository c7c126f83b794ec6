// kill -9 of any process of a make, at any time, then the same command: the same bytes.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

#include "tests/end_to_end/fake_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;

// The process and all its descendants, by /proc.
std::vector<pid_t> family_of(pid_t ancestor) {
  std::map<pid_t, pid_t> parent_of;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string name = entry.path().filename().string();
    if (name.find_first_not_of("0123456789") != std::string::npos) continue;
    std::ifstream stat(entry.path() / "stat");
    std::string text((std::istreambuf_iterator<char>(stat)), {});
    if (text.rfind(')') == std::string::npos) continue;  // gone
    char state = 0;
    pid_t parent = 0;
    if (std::sscanf(text.c_str() + text.rfind(')') + 1, " %c %d", &state, &parent) == 2)
      parent_of[std::stoi(name)] = parent;
  }
  std::vector<pid_t> family{ancestor};
  for (std::size_t i = 0; i < family.size(); ++i)
    for (const auto& [pid, parent] : parent_of)
      if (parent == family[i]) family.push_back(pid);
  return family;
}

bool alive(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  const std::string text((std::istreambuf_iterator<char>(stat)), {});
  const std::size_t name = text.rfind(')');
  return name != std::string::npos && text.compare(name + 1, 2, " Z") != 0;
}

// Whether a stage is at work among them.
bool has_stage(const std::vector<pid_t>& family) {
  return std::ranges::any_of(family, [](pid_t pid) {
    std::error_code gone;
    return fs::read_symlink("/proc/" + std::to_string(pid) + "/exe", gone).filename() == "fake_stage";
  });
}

TEST(Kill, AtAnyTimeLeavesTheSameBytesAfterTheSameCommand) {
  FakeFolder folder("kill");
  folder.profile.replications = 3;
  folder.profile.layer_a.steps = folder.profile.layer_b.steps = 10;
  ASSERT_EQ(shell(folder.command_at(folder.path / "whole", "make")).code, 0);
  // As the repository's Makefile does it: a make that becomes the tool that becomes a make.
  std::ofstream(folder.path / "Makefile")
      << "all:\n\t+@exec " << folder.command("make", "--parent $(shell echo $$PPID)") << " 2>>log\n";

  std::mt19937 random(1);  // any choice will do
  int killed = 0;
  for (int round = 0; killed < 12; ++round) {
    ASSERT_LT(round, 200) << "most runs end before they are killed";
    const pid_t child = ::fork();
    if (child == 0) {
      ::unsetenv("MAKEFLAGS");
      ::unsetenv("MAKELEVEL");
      const std::string path = folder.path.string();
      ::execlp("make", "make", "-s", "-j2", "-C", path.c_str(), nullptr);
      ::_exit(127);
    }
    std::this_thread::sleep_for(std::chrono::microseconds(random() % 300'000));
    const std::vector<pid_t> family = family_of(child);
    const pid_t victim = family[random() % family.size()];
    const bool begun = has_stage(family);
    ::kill(victim, SIGKILL);
    int status = 0;
    ::waitpid(child, &status, 0);
    const bool whole = WIFEXITED(status) && WEXITSTATUS(status) == 0;
    killed += WIFSIGNALED(status) ? WTERMSIG(status) == SIGKILL : !whole && begun;
    if (whole) fs::remove_all(folder.out());  // so that the next run has something to do
    if (victim != child) continue;
    // Whoever started the others is gone: so are they, soon.
    for (const pid_t pid : family)
      for (int patience = 0; patience < 500 && alive(pid); ++patience)
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    for (const pid_t pid : family) EXPECT_FALSE(alive(pid));
  }
  const ShellResult last = folder.make();
  EXPECT_EQ(last.code, 0) << last.text;
  EXPECT_TRUE(folder.artifacts() == FakeFolder::artifacts(folder.path / "whole"));  // and no temporaries
  EXPECT_EQ(shell(folder.command("audit")).code, 0);
}

}  // namespace
}  // namespace hbr
