// A program run as a child that never outlives this process.
#pragma once

#include <string>
#include <vector>

namespace hbr {

struct ChildResult {
  int exit_code = 0;  // -1 where a signal ended it
  int signal = 0;
  bool stopped = false;  // this process was asked to end meanwhile, or before
  double seconds = 0;
};

// Runs it to its end. Termination and interrupt signals are handed on to it, and are reported as its end;
// where one came before, it is not run at all. Throws InputError where it can't be started.
ChildResult run_child(const std::vector<std::string>& command);

// Ends this process when its parent ends (be it by kill -9), and at once where the parent is no longer
// `parent`.
void end_with_parent(int parent);

}  // namespace hbr
