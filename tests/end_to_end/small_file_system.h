// A file system that is soon full, or can only be read.
#pragma once

#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "tests/end_to_end/fake_folder.h"

namespace hbr {

// A small file system over a folder: root mounts it, anyone else in a namespace of their own, which a
// sleeping process keeps.
class SmallFileSystem {
 public:
  SmallFileSystem(const std::filesystem::path& folder, const std::string& options) : folder_(folder) {
    const std::string mount = "mount -t tmpfs -o " + options + " tmpfs " + folder.string();
    mounted = shell(mount).code == 0;
    if (mounted) return;
    keeper_ = ::fork();
    if (keeper_ == 0) {
      ::execlp("unshare", "unshare", "--user", "--mount", "--map-root-user", "sleep", "600", nullptr);
      ::_exit(127);
    }
    words = fmt::format("nsenter --user --mount --preserve-credentials --target {} ", keeper_);
    for (int i = 0; i < 100 && !mounted; ++i) {  // until it is in its namespace, or has ended
      ::usleep(20'000);
      if (::waitpid(keeper_, nullptr, WNOHANG) != 0) {
        keeper_ = -1;
        return;
      }
      mounted = shell(words + mount).code == 0;
    }
  }
  ~SmallFileSystem() {
    if (mounted) shell(words + "umount " + folder_.string());
    if (keeper_ <= 0) return;
    ::kill(keeper_, SIGKILL);
    ::waitpid(keeper_, nullptr, 0);
  }
  SmallFileSystem(const SmallFileSystem&) = delete;

  void change(const std::string& options) const {
    shell(words + "mount -o remount," + options + " " + folder_.string());
  }
  // Where this process, which is outside, sees what is in the folder.
  std::filesystem::path seen() const {
    return keeper_ > 0 ? std::filesystem::path(fmt::format("/proc/{}/root", keeper_) + folder_.string())
                       : folder_;
  }
  bool mounted = false;
  std::string words;  // before a command that is to see it

 private:
  std::filesystem::path folder_;
  pid_t keeper_ = -1;
};

}  // namespace hbr
