// A search that begins with elites from elsewhere instead of random ones: left as the checkpoint that
// `evolve` goes on from.
#pragma once

#include <filesystem>

#include "pipeline/qd/elites.h"
#include "stages/evolve.h"

namespace hbr {

// Offers the elites (with the descriptors and fitness that they have here, ids below generation * batch) in
// order to a new container, and writes the checkpoint of a search that has done that many generations and
// holds what was kept. Throws InputError where the container is `cvt`, whose cells belong to a search from
// the start.
void write_transplant(const std::filesystem::path& checkpoint, const SearchTable& table, const Elites& elites,
                      std::int64_t generation, DescriptorRange range);

}  // namespace hbr
