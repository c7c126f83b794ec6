// How far a make is as a whole: OUT/.plan/tally lists the stages that it is to run, and those that it has
// run.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hbr::inline artifact {

// Begins the list with what is to be run, a name for each run, at this time (seconds after 1970).
void start_tally(const std::filesystem::path& out, const std::vector<std::string>& stages, double now);

// Adds a run that took so long, and tells how far the make is: "37 of 164, about 2:10 left". A stage that
// still has to run counts as long as its runs so far took on average, else as long as all runs did; the time
// is told once a tenth of them is done. "" where no make has begun a list.
std::string count_made(const std::filesystem::path& out, const std::string& stage, double seconds,
                       double now);

}  // namespace hbr::inline artifact
