// How many threads a stage program is given.
#pragma once

#include <filesystem>
#include <string>

namespace hbr::inline artifact {

// The processors that this process may use: its affinity, the quota of its control group (version 1 or 2),
// and what Slurm gave the job. `root` is where /proc and /sys are.
int processors(const std::filesystem::path& root = "/");

// The N of make's -jN (MAKEFLAGS); 1 without, 0 for a -j without a number.
int jobs_of_make();

// Host, and job and step of a cluster: where this process was launched to.
std::string this_place();

// What was asked for. For 0 the processors, shared among make's jobs where these are here: where
// make is not at another place (the environment's HBR_PLACE).
int threads_of_stage(int asked);

}  // namespace hbr::inline artifact
