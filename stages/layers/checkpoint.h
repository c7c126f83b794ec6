// What a search that was stopped goes on from: the arrays of a repertoire file (pipeline/artifact/FORMAT.md),
// and `slot` [n], where each elite stands; `selector`, what the selector has learnt by slot; `generation`
// [1].
#pragma once

#include <filesystem>

#include "pipeline/qd/search.h"

namespace hbr::inline stages {

// Whole or not at all.
void write_checkpoint(const std::filesystem::path& path, const SearchState& state);
// Whether there is one that can be read. A damaged one, as a machine that stopped may leave it, is removed
// and told: what it saved is lost, and no more.
bool can_resume(const std::filesystem::path& path);
// Throws InputError where the file is damaged.
SearchState read_checkpoint(const std::filesystem::path& path);

}  // namespace hbr::inline stages
