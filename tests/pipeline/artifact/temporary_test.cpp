// Who may remove what is being written.
#include "pipeline/artifact/temporary.h"

#include <gtest/gtest.h>

#include <fstream>

#include "pipeline/process/identity.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;

TEST(Temporary, IsRemovedOnlyWhereItsProcessHasEnded) {
  const TemporaryFolder folder;
  const auto write = [&](const Process& process, const std::string& name, std::chrono::minutes age) {
    const fs::path path = folder.path() / (".tmp-" + text_of(process) + "@" + name);
    std::ofstream(path) << "x";
    fs::last_write_time(path, fs::file_time_type::clock::now() - age);
    return path;
  };
  using std::chrono::minutes;
  const Process self = this_process(), ended{self.host, self.id, self.started + 1};
  const Process elsewhere{self.host + "-2", self.id, self.started};  // a name that begins alike
  const fs::path living = write(self, "00.h5", minutes(600)),
                 own = temporary_beside(folder.path() / "a@b.h5"),
                 other = write(elsewhere, "00.h5", minutes(50));
  std::ofstream(own) << "x";
  const fs::path gone[] = {write(ended, "00.h5", minutes(0)), write(ended, "01.h5", minutes(0)),
                           write(elsewhere, "01.h5", minutes(70)), folder.path() / ".tmp-77-00.h5"};
  std::ofstream(gone[3]) << "x";
  // A folder is as young as the youngest in it.
  const fs::path young = write(elsewhere, "report", minutes(0));
  fs::remove(young);
  fs::create_directories(young / "deep");
  std::ofstream(young / "deep/page") << "x";
  for (const char* old : {"deep", ""})
    fs::last_write_time(young / old, fs::file_time_type::clock::now() - minutes(70));
  const fs::path artifact = folder.path() / "00.h5";
  std::ofstream(artifact) << "x";

  remove_abandoned(folder.path());
  for (const fs::path& path : {living, own, other, young, artifact}) EXPECT_TRUE(fs::exists(path)) << path;
  for (const fs::path& path : gone) EXPECT_FALSE(fs::exists(path)) << path;
}

}  // namespace
}  // namespace hbr
