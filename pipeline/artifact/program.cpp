#include "pipeline/artifact/program.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

int told(const std::string& name, const char* before, std::string text, int code) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  const std::string line = fmt::format("{}: {}{}\n", name, before, text);
  std::fputs(line.c_str(), stderr);
  return code;
}

}  // namespace

int guarded_main(const std::string& name, const std::function<int()>& body) {
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return body();
  } catch (const InputError& error) {
    return told(name, "", error.what(), 2);
  } catch (const std::bad_alloc&) {
    return told(name, "", "out of memory", 3);
  } catch (const std::exception& error) {
    return told(name, "unexpected error: ", error.what(), 3);
  }
}

}  // namespace hbr
