#include <algorithm>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/readers.h"

namespace hbr::inline statistics {

void read_numbers(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    const auto legible = file.read<std::uint8_t>("legible").values;
    if (legible.empty())
      throw InputError("{}: legible is empty; expected at least one number", artifact.path.string());
    const std::string prefix = artifact.name.prefix();
    const auto readable = std::ranges::count_if(legible, [](std::uint8_t l) { return l != 0; });
    table.add(prefix + ".legible", artifact.name.replication,
              static_cast<double>(readable) / static_cast<double>(legible.size()));
    table.add(prefix + ".values", artifact.name.replication,
              static_cast<double>(file.read<std::int32_t>("shown/value").values.size()));
  }
}

}  // namespace hbr::inline statistics
