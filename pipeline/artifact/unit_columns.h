// What the attributes of a repertoire's arrays say of their columns, see FORMAT.md.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"

namespace hbr::inline artifact {

// Of `solution` and `measures`: a value stored as `low` in column c stands for from[c], one stored as `high`
// for to[c], in units[c], linear in between.
struct UnitColumns {
  std::vector<std::string> names, units;
  double low = 0, high = 1;
  std::vector<double> from, to;
};
// Throws InputError, naming file, array and attribute, where one is missing or not as expected.
UnitColumns read_unit_columns(const std::filesystem::path& path, const std::string& array);
void write_unit_columns(Hdf5Writer& file, const std::string& array, const UnitColumns& columns);

// Of `objective`.
struct ValueMeaning {
  std::string meaning, units;
};
ValueMeaning read_value_meaning(const std::filesystem::path& path, const std::string& array);
void write_value_meaning(Hdf5Writer& file, const std::string& array, const ValueMeaning& value);

}  // namespace hbr::inline artifact
