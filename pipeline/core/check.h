// Failures and who they are for.
//
// InputError: something a user gave is wrong (a profile, a data file, an artifact, a URDF, a command line).
// Programs print its text as one line and exit with 2. The text says what, where, what was expected, what was
// found and how to mend it.
// HBR_CHECK: a mistake of ours. It stays on in release builds and aborts with the values at hand.
#pragma once

#include <fmt/format.h>

#include <stdexcept>
#include <string>
#include <utility>

namespace hbr::inline core {

class InputError : public std::runtime_error {
 public:
  template <class... Args>
  explicit InputError(fmt::format_string<Args...> text, Args&&... args)
      : std::runtime_error(fmt::format(text, std::forward<Args>(args)...)) {}
};

namespace detail {
[[noreturn]] void check_failed(const char* file, int line, const char* condition, const std::string& values);
}

}  // namespace hbr::inline core

// HBR_CHECK(i < n, "i = {}, n = {}", i, n)
#define HBR_CHECK(condition, ...)                                                              \
  do {                                                                                         \
    if (!(condition)) [[unlikely]]                                                             \
      ::hbr::detail::check_failed(__FILE__, __LINE__, #condition, ::fmt::format(__VA_ARGS__)); \
  } while (false)
