// Work that is not to be trusted with this process: a reader of foreign files may crash, take all memory or
// never end.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace hbr::inline process {

struct OwnProcess {
  std::size_t memory_bytes;  // that the work may take beside what this process has
  unsigned cpu_seconds;

  // Runs `work` in a child of this process and returns what it returns. Throws InputError, with `what` before
  // the words, where the work throws one, crashes, or needs more than it may. That the machine has too little
  // is not told of `what`: std::bad_alloc where the child is killed, std::system_error where there is none.
  std::string run(const std::string& what, const std::function<std::string()>& work) const;
};

}  // namespace hbr::inline process
