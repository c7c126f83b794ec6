// A program run to its end in this process's stead.
#pragma once

#include "pipeline/process/child.h"

namespace hbr::inline process {

struct ChildResult : Ending {
  bool stopped = false;  // this process was asked to end meanwhile, or before
  double seconds = 0;
};

// Runs it to its end. Termination and interrupt signals are handed on to it, and are reported as its end;
// where one came before, it is not run at all. What this process ignores (nohup) it ignores, too.
ChildResult run_child(const std::vector<std::string>& command);

}  // namespace hbr::inline process
