#include "pipeline/artifact/toolchain.h"

#include <fmt/format.h>
#include <gnu/libc-version.h>
#include <hdf5.h>

namespace hbr::inline artifact {
namespace {

// The levels of the x86-64 psABI.
#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512CD__) && defined(__AVX512DQ__) && \
    defined(__AVX512VL__)
constexpr const char* kArchitecture = "x86-64-v4";
#elif defined(__AVX2__) && defined(__FMA__) && defined(__BMI2__)
constexpr const char* kArchitecture = "x86-64-v3";
#elif defined(__SSE4_2__)
constexpr const char* kArchitecture = "x86-64-v2";
#elif defined(__x86_64__)
constexpr const char* kArchitecture = "x86-64";
#elif defined(__aarch64__)
constexpr const char* kArchitecture = "aarch64";
#else
constexpr const char* kArchitecture = "other";
#endif

std::string compiler() {
#ifdef __clang__
  return fmt::format("Clang {}.{}.{}", __clang_major__, __clang_minor__, __clang_patchlevel__);
#else
  return "GCC " __VERSION__;
#endif
}

const char* processor() {
#ifdef __x86_64__
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") &&
      __builtin_cpu_supports("avx512vl"))
    return "x86-64-v4";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"))
    return "x86-64-v3";
  return __builtin_cpu_supports("sse4.2") ? "x86-64-v2" : "x86-64";
#else
  return kArchitecture;
#endif
}

}  // namespace

nlohmann::json toolchain() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return {{"compiler", compiler()},
          {"flags", HBR_FLAGS},
          {"architecture", kArchitecture},
          {"processor", processor()},
          {"libraries", fmt::format("glibc {}, HDF5 {}.{}.{}, {}", gnu_get_libc_version(), major, minor,
                                    release, HBR_LIBRARIES)}};
}

}  // namespace hbr::inline artifact
