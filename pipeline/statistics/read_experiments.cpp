#include <algorithm>
#include <string_view>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/readers.h"
#include "pipeline/statistics/summary.h"

namespace hbr::inline statistics {
namespace {

std::vector<double> read_values(const Hdf5Reader& file, const std::string& name) {
  const Array<float> array = file.read<float>(name);
  if (array.values.empty())
    throw InputError("{}: array {} is empty; expected at least one value", file.path().string(), name);
  return {array.values.begin(), array.values.end()};
}

// "layer2_n10" and "n10" alike.
std::string without_layer(const std::string& name) {
  return name.starts_with("layer") && name.find('_') != std::string::npos ? name.substr(name.find('_') + 1)
                                                                          : name;
}

}  // namespace

void read_comparison(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    table.number("searches.passive_cells", file.number_attribute("settings.passive_cells"));
    table.number("searches.worst_fitness", file.number_attribute("settings.worst_fitness"));
    table.number("searches.filled_by_any", file.number_attribute("filled_by_any"));
    for (const std::string& search : file.children("/"))
      for (const char* measure : {"coverage", "qd_score", "cell_mean"}) {
        const std::vector<double> values = file.read<double>(search + "/" + measure).values;
        for (std::size_t r = 0; r < values.size(); ++r)
          table.add("layer1_search." + search + "." + measure, static_cast<int>(r), values[r]);
      }
  }
}

void read_accuracy(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    for (const std::string& name : file.children("/")) {
      const std::vector<double> errors = read_values(file, name + "/squared_error");
      table.add("accuracy." + without_layer(name), artifact.name.replication,
                summarise(errors, name.c_str()).median);
      table.number("accuracy.requests", static_cast<double>(errors.size()));
    }
  }
}

void read_arc_quality(const std::vector<Artifact>& artifacts, const std::set<std::string>& layers,
                      StatisticsTable& table) {
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    for (const std::string& name : file.children("/")) {
      const bool flat = name.starts_with("flat");
      const std::string subject = flat                    ? "flat_arcs"
                                  : layers.contains(name) ? "layers." + name
                                                          : "layer3." + without_layer(name);
      for (const auto& [array, measure] :
           {std::pair{"fresh", "fresh_mean"}, {"irregularity", "irregularity"}, {"joint_term", "joint_term"}})
        table.add(subject + "." + measure, artifact.name.replication,
                  mean(read_values(file, name + "/" + array)));
    }
  }
}

void read_substitution(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  std::map<std::string, std::vector<double>> pooled;
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    for (const char* layer : {"original", "substitute"}) {
      const Array<float> metrics = file.read<float>(layer);
      if (metrics.shape.size() != 2 || metrics.shape[1] != 3 || metrics.values.empty())
        throw InputError("{}: array {} is not n x 3 with n > 0", artifact.path.string(), layer);
      for (std::size_t m = 0; m < 3; ++m) {
        std::vector<double> values;
        for (std::size_t i = m; i < metrics.values.size(); i += 3) values.push_back(metrics.values[i]);
        const std::string name = fmt::format("substitution.m{}.{}", m + 1, layer);
        table.add(name, artifact.name.replication, summarise(values, name.c_str()).median);
        pooled[name].insert(pooled[name].end(), values.begin(), values.end());
      }
    }
  }
  for (const auto& [name, values] : pooled) table.box(name, values);
}

void read_planes(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  for (const Artifact& artifact : artifacts)
    for (const char* value : {"covered", "scale"})
      table.number(artifact.name.prefix() + "." + value, Hdf5Reader(artifact.path).number_attribute(value));
}

}  // namespace hbr::inline statistics
