// What planning reads, and what a program's hash is of.
#include <elf.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <cstring>

#include "pipeline/artifact/content.h"
#include "pipeline/core/sanitizers.h"
#include "tests/end_to_end/fake_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

// The sanitizers read the table of what is mapped again and again, and its length changes from run to run.
#if HBR_ADDRESS_SANITIZER || HBR_THREAD_SANITIZER
constexpr std::int64_t kSanitizersNoise = 10'000;
#else
constexpr std::int64_t kSanitizersNoise = 0;
#endif

// The bytes that this process and its children that have ended have read, from files and pipes.
std::int64_t bytes_read() {
  std::ifstream counters("/proc/self/io");
  std::string name;
  std::int64_t bytes = -1;
  counters >> name >> bytes;
  EXPECT_EQ(name, "rchar:");
  return bytes;
}

// What planning reads, apart from what it says itself, which comes through a pipe.
std::int64_t bytes_to_plan(const FakeFolder& folder, ShellResult& plan) {
  const std::string command = folder.command("plan");
  const std::int64_t before = bytes_read();
  plan = shell(command);
  return bytes_read() - before - static_cast<std::int64_t>(plan.text.size());
}

// What is hashed of a program.
std::int64_t loaded_bytes(const fs::path& program) {
  const std::string all = read_whole(program);
  Elf64_Ehdr header;
  std::memcpy(&header, all.data(), sizeof header);
  std::int64_t bytes = 0;
  for (std::size_t i = 0; i < header.e_phnum; ++i) {
    Elf64_Phdr segment;
    std::memcpy(&segment, &all[header.e_phoff + i * sizeof segment], sizeof segment);
    if (segment.p_type == PT_LOAD) bytes += static_cast<std::int64_t>(segment.p_filesz);
  }
  return bytes;
}

// As large as the paper's experiment: 50 replications of 18 stages. The stage program is hashed once, not
// once for each of them.
TEST(Runner, ALargeExperimentIsPlannedByReadingNoMoreThanASmallOne) {
  FakeFolder folder("large");
  ShellResult plan;
  folder.profile.replications = 1;
  const std::int64_t small = bytes_to_plan(folder, plan);
  EXPECT_EQ(std::count(plan.text.begin(), plan.text.end(), '\n'), 5);
  EXPECT_GT(small, loaded_bytes(folder.programs / "fake_stage"));
  folder.profile.replications = 450;
  EXPECT_LT(bytes_to_plan(folder, plan), small + 10'000);
  EXPECT_EQ(std::count(plan.text.begin(), plan.text.end(), '\n'), 903);
}

TEST(Runner, AFinishedExperimentIsPlannedWithoutReadingItsArtifactsOrPrograms) {
  FakeFolder folder("finished");
  folder.profile.base.size = folder.profile.layer_a.size = folder.profile.layer_b.size = 100'000;
  folder.make();
  const std::uintmax_t artifact = fs::file_size(folder.out() / "base.h5");
  const std::int64_t program = loaded_bytes(folder.programs / "fake_stage");
  EXPECT_THAT(shell(folder.command("audit")).text, HasSubstr("7 artifacts read again (4.0 MB), 0 missing"));
  ShellResult plan;
  folder.profile.sum.number = 9;
  const std::int64_t without_hashing = bytes_to_plan(folder, plan);
  EXPECT_THAT(plan.text, HasSubstr("slices/sum.json"));
  std::ofstream(folder.out() / ".plan/hashes.json") << "{}";  // what was remembered of the program
  const std::int64_t program_hashed = bytes_to_plan(folder, plan);
  EXPECT_GT(artifact, 300'000u);
  EXPECT_GE(program_hashed - without_hashing, program - 10'000);
  EXPECT_LT(program_hashed - without_hashing, program + 10'000);
  shell("find " + folder.out().string() + " -name base.h5 -exec touch {} +");  // now it has to be read
  EXPECT_GE(bytes_to_plan(folder, plan) - program_hashed,
            static_cast<std::int64_t>(artifact) - kSanitizersNoise);
}

// What goes into manifests, whose texts are UTF-8, is looked at before anything is made.
TEST(Runner, TextsThatAreNoUtf8AreRefusedInOneLine) {
  const FakeFolder folder("latin");
  ::setenv("HBR_LAUNCH", "srun --comment=\xe9", 1);
  const ShellResult launched = folder.make();
  ::unsetenv("HBR_LAUNCH");
  EXPECT_EQ(launched.code, 2);
  EXPECT_THAT(launched.text, HasSubstr("LAUNCH is 'srun --comment=\uFFFD', which is not UTF-8"));
  EXPECT_EQ(std::count(launched.text.begin(), launched.text.end(), '\n'), 1);
  const fs::path latin = folder.path / "jos\xe9";
  const ShellResult outside = shell(folder.command_at(latin, "status"));
  EXPECT_EQ(outside.code, 2);
  EXPECT_THAT(outside.text, HasSubstr("jos\uFFFD', which is not UTF-8"));
  EXPECT_FALSE(fs::exists(latin));
  EXPECT_EQ(folder.make().code, 0);
}

TEST(ProgramHash, LeavesOutDebugInformationOnly) {
  FakeFolder folder("program");
  const fs::path program = std::string(HBR_BINARY_DIR) + "/fake/fake_stage",
                 stripped = folder.path / "stripped";
  shell("strip -g -o " + stripped.string() + " " + program.string());
  EXPECT_NE(content_of(program).sha256, content_of(stripped).sha256);
  EXPECT_EQ(sha256_of_program(program), sha256_of_program(stripped));
  std::fstream file(stripped, std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(static_cast<std::streamoff>(4096 + 100));
  file.put('\x5a');
  file.close();
  EXPECT_NE(sha256_of_program(program), sha256_of_program(stripped));
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(sha256_of_text("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

}  // namespace
}  // namespace hbr
