// What other programs say, run without a shell.
#pragma once

#include "pipeline/process/child.h"

namespace hbr::inline process {

struct Output {
  Ending ending;
  std::string text, errors;  // of the standard output and the standard error
};

// Runs the program to its end on that standard input.
Output output_of(const Program& program, const std::string& input = "");

}  // namespace hbr::inline process
