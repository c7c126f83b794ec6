// Repertoires as other libraries of quality-diversity read them.
#pragma once

#include <filesystem>
#include <string>

#include "pipeline/qd/elites.h"

namespace hbr::inline stages {

struct StoredRepertoire {
  Elites elites;
  Rows centroids;                  // [cells x d] of the cvt container; else the elites' own descriptors
  std::vector<std::int32_t> cell;  // of each elite: the centroid nearest to it, else its own row
};
// Throws InputError where the file is not as FORMAT.md says, or a cell has two elites.
StoredRepertoire read_repertoire(const std::filesystem::path& file);

// pyribs' ArchiveDataFrame as its to_csv writes it without row labels: solution_0 ..., objective, measures_0
// ..., then as its extra fields id, parent, length and uncertainty (the last two where they exist), and
// index, the elite's cell. Numbers have the digits that tell them from all other floats.
std::string pyribs_csv(const StoredRepertoire& repertoire);

// The folder that QDax's MapElitesRepertoire.load reads: genotypes.npy [cells x genes], fitnesses.npy [cells
// x 1], descriptors.npy and centroids.npy [cells x d], float32. Empty cells have the fitness -inf and zeros.
// The folder must not be there.
void write_qdax(const StoredRepertoire& repertoire, const std::filesystem::path& folder);

}  // namespace hbr::inline stages
