// What the search and the hierarchy do, as one number (signature.cpp), which a change of behaviour must
// change knowingly, here; and the same number whatever the processor that they are compiled for.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <string>

namespace hbr {
namespace {

constexpr const char* kSignature = "80bd23aefc81351e";

std::string signature_of(const std::string& target) {
  const std::string program = std::string(HBR_BINARY_DIR) + "/signature/signature_" + target;
  std::array<char, 64> line{};
  FILE* pipe = ::popen(program.c_str(), "r");
  const bool read = pipe && std::fgets(line.data(), line.size(), pipe);
  const int status = pipe ? ::pclose(pipe) : -1;
  return read && status == 0 ? std::string(line.data(), 16) : "none: " + program + " failed";
}

class SignatureOf : public testing::TestWithParam<const char*> {};

TEST_P(SignatureOf, TheSearchAndTheHierarchyIsTheKeptOne) {
#ifdef __x86_64__
  if (std::string(GetParam()) == "x86-64-v3") {
    if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "this processor has no AVX2, which x86-64-v3 needs";
    if (!__builtin_cpu_supports("fma")) GTEST_SKIP() << "this processor has no FMA, which x86-64-v3 needs";
  }
#endif
  EXPECT_EQ(signature_of(GetParam()), kSignature)
      << "if the change is meant to change behaviour, keep the new number in this file and say so";
}

INSTANTIATE_TEST_SUITE_P(Targets, SignatureOf, testing::Values(HBR_SIGNATURE_TARGETS), [](const auto& test) {
  std::string name = test.param;
  for (char& c : name)
    if (c == '-') c = '_';
  return name;
});

}  // namespace
}  // namespace hbr
