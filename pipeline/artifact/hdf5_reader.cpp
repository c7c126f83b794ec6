#include <algorithm>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/hdf5_handle.h"
#include "pipeline/core/file_error.h"

namespace hbr::inline artifact {
namespace {

// The product of the other dimensions of an array with a dimension of 0 may be as large as that in any file.
constexpr std::uint64_t kWidestEmpty = 1 << 16;

}  // namespace

struct Hdf5Reader::File {
  std::filesystem::path path;
  std::uintmax_t bytes = 0;
  Hdf5Handle id;

  [[noreturn]] void fail(const std::string& what, const std::string& reason) const {
    throw InputError("{}: {}: {}", path.string(), what, reason);
  }
  bool has_link(const std::string& name) const {
    for (std::size_t at = name.find('/', 1); at != std::string::npos; at = name.find('/', at + 1))
      if (H5Lexists(id, name.substr(0, at).c_str(), H5P_DEFAULT) <= 0) return false;
    return H5Lexists(id, name.c_str(), H5P_DEFAULT) > 0;
  }
  Hdf5Handle attribute(const std::string& name) const {
    Hdf5Handle found(H5Aopen(id, name.c_str(), H5P_DEFAULT), H5Aclose);
    if (!found.valid()) fail(name, "the file has no attribute of that name, or is damaged");
    const Hdf5Handle space(H5Aget_space(found), H5Sclose);
    if (H5Sget_simple_extent_npoints(space) != 1) fail(name, "expected an attribute with one value");
    return found;
  }
};

Hdf5Reader::Hdf5Reader(const std::filesystem::path& path) : file_(std::make_unique<File>()) {
  hdf5_silence();
  file_->path = path;
  std::error_code error;
  file_->bytes = std::filesystem::file_size(path, error);
  if (error) throw file_error(path, "can't read this file", error.value());
  file_->id = hdf5_open(path);
  if (!file_->id.valid())
    throw InputError("{}: not an HDF5 file, damaged, or not readable ({})", path.string(), hdf5_reason());
}

Hdf5Reader::~Hdf5Reader() = default;

const std::filesystem::path& Hdf5Reader::path() const { return file_->path; }

bool Hdf5Reader::has(const std::string& name) const { return file_->has_link(name); }

template <class T>
Array<T> Hdf5Reader::read(const std::string& name) const {
  if (!has(name)) file_->fail(name, "the file has no array of that name");
  const Hdf5Handle set(H5Dopen2(file_->id, name.c_str(), H5P_DEFAULT), H5Dclose);
  if (!set.valid()) file_->fail(name, fmt::format("expected an array ({})", hdf5_reason()));
  const Hdf5Handle type(H5Dget_type(set), H5Tclose);
  if (H5Tequal(type, hdf5_type<T>()) <= 0) {
    const char* expected = std::is_same_v<T, float>          ? "float32"
                           : std::is_same_v<T, double>       ? "float64"
                           : std::is_same_v<T, std::uint8_t> ? "uint8"
                           : std::is_same_v<T, std::int32_t> ? "int32"
                                                             : "int64";
    const char* kind = H5Tget_class(type) == H5T_FLOAT     ? "float"
                       : H5Tget_class(type) == H5T_INTEGER ? "int"
                                                           : "other";
    file_->fail(name, fmt::format("expected elements of type {}, found {} of {} bits", expected, kind,
                                  H5Tget_size(type) * 8));
  }
  const Hdf5Handle space(H5Dget_space(set), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 1) file_->fail(name, "expected an array with at least one dimension");
  std::vector<hsize_t> dimensions(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space, dimensions.data(), nullptr);

  // A damaged size must not become a huge allocation: what is stored can't be more than the file holds.
  const bool empty = std::find(dimensions.begin(), dimensions.end(), hsize_t{0}) != dimensions.end();
  // Of an array without elements nothing is stored; but a caller may make room by its other dimensions.
  const std::uint64_t limit =
      empty ? std::max<std::uint64_t>(file_->bytes, kWidestEmpty)
            : std::min<std::uint64_t>(file_->bytes, H5Dget_storage_size(set)) / sizeof(T);
  std::uint64_t count = 1;
  for (const hsize_t n : dimensions) {
    if (n > limit / count)
      file_->fail(
          name,
          fmt::format(
              "its shape [{}] asks for more than {}: the file is damaged", fmt::join(dimensions, ", "),
              empty ? fmt::format("an array without elements may, {} in all but the dimensions of 0", limit)
                    : fmt::format("the {} elements stored", limit)));
    count *= std::max<hsize_t>(n, 1);
  }
  if (empty) count = 0;
  Array<T> array;
  array.shape.assign(dimensions.begin(), dimensions.end());
  array.values.resize(count);
  if (count > 0 && H5Dread(set, hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, array.values.data()) < 0)
    file_->fail(name, fmt::format("the stored values are damaged ({})", hdf5_reason()));
  return array;
}

template Array<float> Hdf5Reader::read(const std::string&) const;
template Array<double> Hdf5Reader::read(const std::string&) const;
template Array<std::uint8_t> Hdf5Reader::read(const std::string&) const;
template Array<std::int32_t> Hdf5Reader::read(const std::string&) const;
template Array<std::int64_t> Hdf5Reader::read(const std::string&) const;

std::vector<std::string> Hdf5Reader::children(const std::string& group) const {
  if (group != "/" && !has(group)) file_->fail(group, "the file has no group of that name");
  const Hdf5Handle opened(H5Gopen2(file_->id, group.c_str(), H5P_DEFAULT), H5Gclose);
  if (!opened.valid()) file_->fail(group, fmt::format("expected a group ({})", hdf5_reason()));
  std::vector<std::string> names;
  const herr_t result = H5Literate(
      opened, H5_INDEX_NAME, H5_ITER_INC, nullptr,
      [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
        static_cast<std::vector<std::string>*>(list)->emplace_back(name);
        return 0;
      },
      &names);
  if (result < 0) file_->fail(group, fmt::format("the group is damaged ({})", hdf5_reason()));
  return names;
}

bool Hdf5Reader::has_attribute(const std::string& name) const {
  return H5Aexists(file_->id, name.c_str()) > 0;
}

std::string Hdf5Reader::text_attribute(const std::string& name) const {
  const Hdf5Handle found = file_->attribute(name);
  const Hdf5Handle type(H5Aget_type(found), H5Tclose);
  if (H5Tis_variable_str(type) <= 0) file_->fail(name, "expected an attribute with a text");
  char* text = nullptr;
  if (H5Aread(found, hdf5_text_type(), &text) < 0)
    file_->fail(name, fmt::format("the attribute is damaged ({})", hdf5_reason()));
  std::string value(text ? text : "");
  H5free_memory(text);
  return value;
}

double Hdf5Reader::number_attribute(const std::string& name) const {
  const Hdf5Handle found = file_->attribute(name);
  const Hdf5Handle type(H5Aget_type(found), H5Tclose);
  const H5T_class_t kind = H5Tget_class(type);
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) file_->fail(name, "expected an attribute with a number");
  double value = 0;
  if (H5Aread(found, H5T_NATIVE_DOUBLE, &value) < 0)
    file_->fail(name, fmt::format("the attribute is damaged ({})", hdf5_reason()));
  return value;
}

}  // namespace hbr::inline artifact
