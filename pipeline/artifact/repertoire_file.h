// Repertoires as files, see FORMAT.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/qd/elites.h"

namespace hbr::inline artifact {

// Writes the arrays of a repertoire and of its search into an open file.
void write_elites(Hdf5Writer& file, const Elites& elites, const std::vector<ProgressRow>& progress);

// Reads and checks them: shapes that agree, finite numbers, genes in [0, 1], ascending ids, lengths in range.
// Throws InputError with file, array, expected and found.
Elites read_elites(const std::filesystem::path& path);
std::vector<ProgressRow> read_progress(const std::filesystem::path& path);

}  // namespace hbr::inline artifact
