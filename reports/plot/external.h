// Runs another program (gnuplot, rsvg-convert, dot) without a shell.
#pragma once

#include <string>
#include <vector>

namespace hbr::inline reports {

// Starts command[0], found through PATH, feeds `input` to its standard input and returns its standard output.
// The environment is ours plus LC_ALL=C and SOURCE_DATE_EPOCH=0, so that neither place nor time reach the
// output. Throws InputError, with what the program said, where it is missing, fails or is killed.
std::string run_program(const std::vector<std::string>& command, const std::string& input);

}  // namespace hbr::inline reports
