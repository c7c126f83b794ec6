// The experiment as a stage graph.
#pragma once

#include <filesystem>

#include "pipeline/artifact/graph.h"

namespace hbr {

// Reads a profile strictly (InputError: file, line, column) and cuts it into one slice per stage and replication.
Graph experiment_graph(const std::filesystem::path& profile_file);

}  // namespace hbr
