#include "pipeline/artifact/program.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

int told(const char* program, const char* before, std::string text, int code) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  const std::string line =
      fmt::format("{}: {}{}\n", std::filesystem::path(program).filename().string(), before, text);
  std::fputs(line.c_str(), stderr);
  return code;
}

}  // namespace

int guarded_main(const char* program, const std::function<int()>& body) {
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return body();
  } catch (const InputError& error) {
    return told(program, "", error.what(), 2);
  } catch (const std::bad_alloc&) {
    return told(program, "", "out of memory", 3);
  } catch (const std::exception& error) {
    return told(program, "unexpected error: ", error.what(), 3);
  }
}

}  // namespace hbr
