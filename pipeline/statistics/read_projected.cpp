#include <algorithm>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/readers.h"
#include "pipeline/statistics/summary.h"

namespace hbr::inline statistics {

void read_projected(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    const double spacing = file.number_attribute("settings.spacing");
    const auto values = [&](const std::string& name, double scale) {
      const auto read = file.read<float>(name).values;
      if (read.empty()) throw InputError("{}: array {} is empty", artifact.path.string(), name);
      std::vector<double> scaled(read.begin(), read.end());
      for (double& value : scaled) value *= scale;
      return scaled;
    };
    const auto add = [&](const std::string& measure, double value) {
      table.add(artifact.name.prefix() + "." + measure, artifact.name.replication, value);
    };
    for (const std::string when : {"before", "after"}) {
      const auto median = [&](const char* name, double scale) {
        return summarise(values(when + "/" + name, scale), name).median;
      };
      const std::vector<double> nearest = values(when + "/nearest", 1 / spacing);
      const auto within = std::ranges::count_if(nearest, [](double d) { return d <= 1; });
      add("within_" + when, static_cast<double>(within) / static_cast<double>(nearest.size()));
      add("nearest_" + when, summarise(nearest, "nearest").median);
      add("off_plane_" + when, median("off_plane", 1000));
      add("distance_" + when, median("distance", 1000));
      add("variance_" + when, mean(values(when + "/variance", 1)));
    }
    const auto evolved = values("before/variance", 1).size(), all = values("objective", 1).size();
    add("added", static_cast<double>(all) - static_cast<double>(evolved));
  }
}

}  // namespace hbr::inline statistics
