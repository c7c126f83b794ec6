// How long a run would take on more processors: a model from what its stages needed.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pipeline/artifact/manifest.h"

namespace hbr::inline reports {

// A run of a stage on one processor.
struct Job {
  std::string stage;
  double seconds = 0;
  std::vector<std::size_t> after;  // the jobs that make what it reads; there is no circle
};

// One for each manifest of a lineage, with its processor time.
std::vector<Job> jobs_of(const std::map<std::string, Manifest>& lineage);

// Seconds until the last job is done, where each of so many processors takes, as soon as it is free, of the
// jobs that can begin the one that the longest chain of others waits for (list scheduling; Graham 1966: at
// most twice the best).
double makespan(const std::vector<Job>& jobs, int processors);

// The longest chain of jobs that wait for each other, the first one first: no number of processors is faster.
std::vector<std::size_t> critical_path(const std::vector<Job>& jobs);

}  // namespace hbr::inline reports
