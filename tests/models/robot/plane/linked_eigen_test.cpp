// Programs and shared libraries both have copies of Eigen's functions, compiled for other vectors: memory
// that one allocates the other can't free. None may take another's for its own. This program has all that
// robots need.
#include <gtest/gtest.h>

#include <cstdio>
#include <memory>
#include <string>

namespace hbr {
namespace {

// Lines of what a command writes.
std::string first_line(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"), pclose);
  std::string line;
  for (int c; (c = std::fgetc(pipe.get())) != EOF && c != '\n';) line += static_cast<char>(c);
  return line;
}

const std::string kProgram = HBR_BINARY_DIR "/bin/test_models_robot";

TEST(LinkedEigen, NothingOfItIsThereForLibraries) {
  EXPECT_NE(first_line("nm -C --defined-only " + kProgram + " | grep -m1 Eigen::"), "");
  EXPECT_EQ(first_line("nm -CD --defined-only " + kProgram + " | grep -m1 Eigen::"), "");
}

TEST(LinkedEigen, NoLibraryThatUsesItIsPartOfUs) {
  EXPECT_NE(first_line("nm -C --undefined-only " + kProgram + " | grep -m1 ceres::"), "");
  EXPECT_EQ(first_line("nm -C --defined-only " + kProgram + " | grep -m1 ' [TW] ceres::internal::'"), "");
}

}  // namespace
}  // namespace hbr
