// What other robots made of the arm's lines, arcs and digits.
#include <fmt/format.h>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/readers.h"
#include "pipeline/statistics/summary.h"

namespace hbr {
namespace {

// Values of one kind: a median for each replication, and all of them together.
class Pooled {
 public:
  explicit Pooled(StatisticsTable& table) : table_(table) {}

  // All values of an array, multiplied by `scale`, under NAME.
  void add(const Artifact& artifact, const Hdf5Reader& file, const std::string& array,
           const std::string& measure, double scale) {
    const std::vector<float> read = file.read<float>(array).values;
    if (read.empty())
      throw InputError("{}: array {} is empty; expected at least one value", file.path().string(), array);
    std::vector<double> values(read.begin(), read.end());
    for (double& value : values) value *= scale;
    const std::string name = artifact.name.prefix() + "." + measure;
    table_.add(name, artifact.name.replication, summarise(values, name.c_str()).median);
    std::vector<double>& all = values_[name];
    all.insert(all.end(), values.begin(), values.end());
  }
  const std::map<std::string, std::vector<double>>& values() const { return values_; }
  void write_boxes() const {
    for (const auto& [name, values] : values_) table_.box(name, values);
  }

 private:
  StatisticsTable& table_;
  std::map<std::string, std::vector<double>> values_;
};

}  // namespace

void read_transfer(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  Pooled differences(table), errors(table);
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    for (const char* difference : {"absolute", "squared"})  // in per cent, as in the paper
      differences.add(artifact, file, difference, difference, 100);
    for (const char* error : {"end", "displacement"})
      errors.add(artifact, file, std::string("lines/") + error, std::string("line_") + error, 1);
    for (const char* error : {"end", "centre", "length"})
      errors.add(artifact, file, std::string("arcs/") + error, std::string("arc_") + error, 1);
  }
  differences.write_boxes();
  errors.write_boxes();
  for (const auto& [name, values] : differences.values()) {
    const Box b = box(values, name.c_str());
    const auto n = static_cast<double>(b.all.n);
    table.number(name + "_median", b.all.median);
    table.number(name + "_low", b.low);
    table.number(name + "_high", b.high);
    table.number(name + "_outliers", 100 * static_cast<double>(b.above) / n);
    table.number(name.substr(0, name.rfind('.')) + ".images", n);
  }
}

}  // namespace hbr
