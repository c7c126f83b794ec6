// The experiment: which stages a profile asks for, what each is told and what it reads. Read top to bottom,
// this folder is the paper.
#pragma once

#include <filesystem>

#include "pipeline/artifact/graph.h"

namespace hbr::inline stages {

// Throws InputError, with the file's name, where the profile is wrong.
Graph experiment_graph(const std::filesystem::path& profile);

}  // namespace hbr::inline stages
