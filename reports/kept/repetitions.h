// What Google Benchmark wrote (--benchmark_out), as far as the table of speed asks for it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hbr::inline reports {

struct Repetition {
  double rate = 0;                        // items per CPU second
  std::map<std::string, double> numbers;  // all that it tells, counters among them
};

// The fastest repetition of every benchmark that counts items, by its name without the tail that repetitions
// add. Throws InputError, "FILE: benchmarks.0.run_name: expected ..., found ...", where a file is something
// else.
std::map<std::string, Repetition> fastest_repetitions(const std::vector<std::filesystem::path>& results);

}  // namespace hbr::inline reports
