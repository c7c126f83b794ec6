#include "pipeline/artifact/unit_columns.h"

#include "pipeline/artifact/hdf5_handle.h"
#include "pipeline/core/check.h"

namespace hbr::inline artifact {
namespace {

constexpr hssize_t kMostColumns = 1 << 16;

// The attributes of one array.
class ArrayAttributes {
 public:
  ArrayAttributes(const std::filesystem::path& path, const std::string& array)
      : path_(path.string()), array_(array) {
    const Hdf5Reader checked(path);  // says what is wrong with the file itself
    if (!checked.has(array)) throw InputError("{}: {}: the file has no array of that name", path_, array);
    file_ = hdf5_open(path);
    object_ = Hdf5Handle(H5Oopen(file_, array.c_str(), H5P_DEFAULT), H5Oclose);
  }

  std::vector<double> numbers(const std::string& name) const {
    const Hdf5Handle found = open(name);
    const Hdf5Handle type(H5Aget_type(found), H5Tclose);
    const H5T_class_t kind = H5Tget_class(type);
    if (kind != H5T_INTEGER && kind != H5T_FLOAT) fail(name, "expected an attribute with numbers");
    std::vector<double> values(count(name, found));
    if (!values.empty() && H5Aread(found, H5T_NATIVE_DOUBLE, values.data()) < 0)
      fail(name, fmt::format("the attribute is damaged ({})", hdf5_reason()));
    return values;
  }
  std::vector<std::string> texts(const std::string& name) const {
    const Hdf5Handle found = open(name);
    const Hdf5Handle type(H5Aget_type(found), H5Tclose);
    if (H5Tis_variable_str(type) <= 0) fail(name, "expected an attribute with texts");
    std::vector<char*> read(count(name, found));
    if (!read.empty() && H5Aread(found, hdf5_text_type(), read.data()) < 0)
      fail(name, fmt::format("the attribute is damaged ({})", hdf5_reason()));
    std::vector<std::string> values;
    for (char* text : read) {
      values.emplace_back(text ? text : "");
      H5free_memory(text);
    }
    return values;
  }
  template <class T>
  T one(const std::string& name, const std::vector<T>& values) const {
    if (values.size() != 1) fail(name, "expected an attribute with one value");
    return values[0];
  }
  [[noreturn]] void fail(const std::string& name, const std::string& reason) const {
    throw InputError("{}: {}: {}: {}", path_, array_, name, reason);
  }

 private:
  Hdf5Handle open(const std::string& name) const {
    Hdf5Handle found(H5Aopen(object_, name.c_str(), H5P_DEFAULT), H5Aclose);
    if (!found.valid()) fail(name, "the array has no attribute of that name, or is damaged; make it again");
    return found;
  }
  std::size_t count(const std::string& name, const Hdf5Handle& found) const {
    const Hdf5Handle space(H5Aget_space(found), H5Sclose);
    const hssize_t n = H5Sget_simple_extent_npoints(space);
    if (n < 0 || n > kMostColumns) fail(name, "the attribute is damaged");
    return static_cast<std::size_t>(n);
  }

  std::string path_, array_;
  Hdf5Handle file_, object_;
};

}  // namespace

UnitColumns read_unit_columns(const std::filesystem::path& path, const std::string& array) {
  const ArrayAttributes of(path, array);
  UnitColumns columns{of.texts("names"),
                      of.texts("units"),
                      of.one("low", of.numbers("low")),
                      of.one("high", of.numbers("high")),
                      of.numbers("from"),
                      of.numbers("to")};
  const std::size_t n = columns.names.size();
  if (columns.units.size() != n) of.fail("units", fmt::format("expected {} texts, as names has", n));
  if (columns.from.size() != n || columns.to.size() != n)
    of.fail("from, to", fmt::format("expected {} numbers each, as names has texts", n));
  if (!(columns.low < columns.high)) of.fail("low, high", "expected the first to be less");
  return columns;
}

void write_unit_columns(Hdf5Writer& file, const std::string& array, const UnitColumns& columns) {
  file.attribute("names", columns.names, array);
  file.attribute("low", columns.low, array);
  file.attribute("high", columns.high, array);
  file.attribute("units", columns.units, array);
  file.attribute("from", columns.from, array);
  file.attribute("to", columns.to, array);
}

ValueMeaning read_value_meaning(const std::filesystem::path& path, const std::string& array) {
  const ArrayAttributes of(path, array);
  return {of.one("meaning", of.texts("meaning")), of.one("units", of.texts("units"))};
}

void write_value_meaning(Hdf5Writer& file, const std::string& array, const ValueMeaning& value) {
  file.attribute("meaning", value.meaning, array);
  file.attribute("units", value.units, array);
}

}  // namespace hbr::inline artifact
