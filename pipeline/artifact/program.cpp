#include "pipeline/artifact/program.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>

#include "pipeline/core/file_error.h"
#include "pipeline/core/memory_limit.h"

namespace hbr::inline artifact {
namespace fs = std::filesystem;
namespace {

int told(const std::string& name, const char* before, std::string text, int code) {
  std::replace(text.begin(), text.end(), '\n', ' ');
  const std::string line = fmt::format("{}: {}{}\n", name, before, text);
  std::fputs(line.c_str(), stderr);
  return code;
}

std::string out_of_memory() {
  return fmt::format("out of memory: at most {}; raise the limit, or use fewer THREADS or jobs (-j)",
                     memory_limit());
}

}  // namespace

int guarded_main(const std::string& name, const std::function<int()>& body) {
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return body();
  } catch (const InputError& error) {
    return told(name, "", error.what(), 2);
  } catch (const fs::filesystem_error& error) {
    return told(name, "", file_error(error).what(), 2);
  } catch (const StageFailure& failure) {
    return told(name, "", failure.what(), 1);
  } catch (const std::bad_alloc&) {
    return told(name, "", out_of_memory(), 3);
  } catch (const std::system_error& error) {
    const std::error_code code = error.code();
    if (code == std::errc::not_enough_memory) return told(name, "", out_of_memory(), 3);
    const char* remedy = code == std::errc::resource_unavailable_try_again
                             ? "; use fewer THREADS or jobs, or raise ulimit -u"
                         : code == std::errc::too_many_files_open ? "; raise ulimit -n"
                                                                  : "";
    return told(name, "", error.what() + std::string(remedy), 3);
  } catch (const std::exception& error) {
    const std::string text = error.what();
    // OpenCV's own word for it.
    if (text.find("Insufficient memory") != std::string::npos) return told(name, "", out_of_memory(), 3);
    return told(name, "unexpected error: ", text, 3);
  }
}

}  // namespace hbr::inline artifact
