#include "stages/layers/description.h"

#include "pipeline/core/check.h"

namespace hbr::inline stages {
namespace {

void write_coordinates(Hdf5Writer& file, const std::string& array, const Coordinates& coordinates, double low,
                       double high) {
  std::vector<std::string> names, units;
  std::vector<double> from, to;
  for (const Coordinate& c : coordinates) {
    names.push_back(c.name);
    units.push_back(c.unit);
    from.push_back(c.low);
    to.push_back(c.high);
  }
  file.attribute("names", names, array);
  file.attribute("low", low, array);
  file.attribute("high", high, array);
  file.attribute("units", units, array);
  file.attribute("from", from, array);
  file.attribute("to", to, array);
}

}  // namespace

void write_description(Hdf5Writer& file, const LayerModel& model) {
  HBR_CHECK(!model.descriptor().empty(), "a layer that is only executed has no descriptor to tell of");
  write_coordinates(file, "solution", model.genome().coordinates(), 0, 1);
  write_coordinates(file, "measures", model.descriptor(), model.low(), model.high());
  file.attribute("meaning", model.fitness().meaning, "objective");
  file.attribute("units", model.fitness().unit, "objective");
}

}  // namespace hbr::inline stages
