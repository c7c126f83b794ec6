// Arrays and attributes in an HDF5 file (serial), see FORMAT.md: row-major, chunked, checksummed, without
// time stamps, so that equal contents are equal bytes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace hbr::inline artifact {

// An array with its shape; `values` is row-major and has as many entries as the shape says.
template <class T>
struct Array {
  std::vector<std::size_t> shape;
  std::vector<T> values;
};

// T is one of float, double, std::uint8_t, std::int32_t, std::int64_t. A name may hold '/': groups are made.
class Hdf5Writer {
 public:
  // Creates (or truncates) the file. Throws InputError where it can't be written.
  explicit Hdf5Writer(const std::filesystem::path& path);
  ~Hdf5Writer();
  Hdf5Writer(const Hdf5Writer&) = delete;

  template <class T>
  void write(const std::string& name, const std::vector<std::size_t>& shape, const T* values);
  template <class T>
  void write(const std::string& name, const std::vector<T>& values) {
    write(name, {values.size()}, values.data());
  }
  template <class T>
  void write(const std::string& name, const Array<T>& array) {
    write(name, array.shape, array.values.data());
  }
  // Attributes of the file's root, or of the array `of`; a string may be long, a list empty.
  void attribute(const std::string& name, const std::string& value, const std::string& of = "/");
  void attribute(const std::string& name, double value, const std::string& of = "/");
  void attribute(const std::string& name, std::int64_t value, const std::string& of = "/");
  void attribute(const std::string& name, const std::vector<std::string>& values,
                 const std::string& of = "/");
  void attribute(const std::string& name, const std::vector<double>& values, const std::string& of = "/");
  void attribute(const std::string& name, const std::vector<std::int64_t>& values,
                 const std::string& of = "/");
  // Flushes and closes; throws InputError where that fails (a full disk). The destructor closes without a
  // word.
  void close();

 private:
  struct File;
  std::unique_ptr<File> file_;
};

class Hdf5Reader {
 public:
  // Throws InputError, naming the file, where it is missing, damaged or not HDF5.
  explicit Hdf5Reader(const std::filesystem::path& path);
  ~Hdf5Reader();
  Hdf5Reader(const Hdf5Reader&) = delete;

  bool has(const std::string& name) const;
  // Throws InputError, naming file and array, where the name, the element type or the checksum is not as
  // expected. Sizes are checked against the file's before anything is allocated.
  template <class T>
  Array<T> read(const std::string& name) const;
  std::vector<std::string> children(const std::string& group) const;  // sorted; "/" is the root
  bool has_attribute(const std::string& name) const;
  std::string text_attribute(const std::string& name) const;
  double number_attribute(const std::string& name) const;
  const std::filesystem::path& path() const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace hbr::inline artifact
