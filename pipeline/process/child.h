// Children of this process: the one place where they are started, waited for and told to end. What can't be
// started is an InputError; where the machine lacks processes, memory or open files for it,
// std::system_error.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace hbr::inline process {

// How a process ended.
struct Ending {
  int exit_code = 0;  // -1 where a signal ended it
  int signal = 0;
};

struct Program {
  std::vector<std::string> words;             // the first is found through PATH
  std::vector<std::string> environment = {};  // "NAME=value" each; empty: this process's
};

// Open files that a program has as its standard input, output and errors; -1: those of this process.
struct StandardFiles {
  int input = -1, output = -1, errors = -1;
};

// Starts a copy of this process, which does the work and ends with the exit code that this returns. Gives its
// number.
int start_work(const std::function<int()>& work);

// Starts a program, which never outlives this process, and gives its number. No signal is blocked in it.
int start_program(const Program& program, const StandardFiles& files = {});

// Waits for the end of a child that was started here.
Ending wait_for(int child);

// Becomes the program; number, environment and open files stay.
[[noreturn]] void become(const std::vector<std::string>& words);

// Has this process be sent the signal when its parent ends, be it by kill -9.
void signal_at_end_of_parent(int signal);

// Ends this process when its parent ends, and at once where the parent is no longer `parent`.
void end_with_parent(int parent);

}  // namespace hbr::inline process
