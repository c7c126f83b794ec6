// The tool behind the Makefile: make, plan, run, status, audit and graph.
#pragma once

#include <filesystem>
#include <functional>

#include "pipeline/artifact/graph.h"

namespace hbr::inline artifact {

// `experiment` reads a profile and cuts it into the stage graph; it throws InputError where the profile is
// wrong.
int tool_main(int argc, char** argv,
              const std::function<Graph(const std::filesystem::path& profile)>& experiment);

}  // namespace hbr::inline artifact
