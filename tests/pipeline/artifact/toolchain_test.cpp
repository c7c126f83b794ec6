// What the manifest says of the compiler is the compiler's own.
#include "pipeline/artifact/toolchain.h"

#include <gmock/gmock.h>

#include "pipeline/core/sanitizers.h"

namespace hbr {
namespace {

TEST(Toolchain, NamesTheCompiler) {
  const std::string compiler = toolchain().at("compiler");
#ifdef __clang__
  EXPECT_EQ(compiler, "Clang " + std::to_string(__clang_major__) + "." + std::to_string(__clang_minor__) +
                          "." + std::to_string(__clang_patchlevel__));
#else
  EXPECT_EQ(compiler, "GCC " + std::to_string(__GNUC__) + "." + std::to_string(__GNUC_MINOR__) + "." +
                          std::to_string(__GNUC_PATCHLEVEL__));
#endif
}

TEST(Toolchain, FlagsAreThoseOfTheCode) {
  const std::string flags = toolchain().at("flags");
  EXPECT_THAT(flags, testing::HasSubstr("-ffp-contract=off"));
  // Two processors that are both native are not one and the same.
  EXPECT_THAT(flags, testing::Not(testing::ContainsRegex("-march=native( [^(]|$)")));
  EXPECT_THAT(flags, testing::Not(testing::ContainsRegex("-W|-g[0-9]?( |$)|prefix-map|" HBR_SOURCE_DIR)));
}

// Whichever compiler it is: they say it in different ways.
TEST(Toolchain, TellsWhichSanitizerItIsFor) {
  const std::string flags = toolchain().at("flags");
  const auto asked_for = [&](const char* sanitizer) {
    return flags.find(std::string("-fsanitize=") + sanitizer) != std::string::npos;
  };
  EXPECT_EQ(HBR_THREAD_SANITIZER, asked_for("thread")) << flags;
  EXPECT_EQ(HBR_ADDRESS_SANITIZER, asked_for("address")) << flags;
}

TEST(Toolchain, NamesTheLibrariesThatMakeBytes) {
  const std::string libraries = toolchain().at("libraries");
  for (const char* name :
       {"glibc", "HDF5", "Eigen", "OpenCV", "zlib", "Simbody", "Ceres", "assimp", "meshoptimizer"})
    EXPECT_THAT(libraries, testing::ContainsRegex(std::string("(^|, )") + name + " [0-9]+\\.[0-9]"));
}

}  // namespace
}  // namespace hbr
