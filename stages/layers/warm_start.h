// A search that begins with elites from elsewhere instead of random ones: how the evolution of a layer goes
// on when what is below it has changed.
#pragma once

#include <filesystem>

#include "pipeline/core/parallel.h"
#include "pipeline/qd/elites.h"
#include "stages/layers/evolve.h"

namespace hbr::inline stages {

// The same genomes with the descriptors, fitness and uncertainty that they have here; row i draws from
// seed.child(i). Those without a behaviour here are left out.
Elites described(const Elites& elites, const Evaluator& evaluator, Seed seed, Workers& workers);

// Writes the checkpoint of a search that has done that many generations and holds the elites (with the
// descriptors and fitness that they have here, ids below generation * batch), but those that are nearer to
// another than the search's container would let them come: of two the better one stays. Nobody has any
// curiosity yet. Throws InputError where the container is `cvt`, whose cells belong to a search from the
// start.
void write_warm_start(const std::filesystem::path& checkpoint, const SearchTable& table, const Elites& elites,
                      std::int64_t generation, DescriptorRange range);

// As `evolve`: the last `more` of the table's generations, from elites of a search that did those before
// elsewhere. They are described here first.
void evolve_on(StageRun& stage, const SearchTable& table, std::int64_t more, const Elites& elites,
               const Variation& variation, const Evaluator& evaluator, Seed seed, DescriptorRange range = {},
               const std::function<void(Hdf5Writer&, const Elites&)>& finish = nullptr);

}  // namespace hbr::inline stages
