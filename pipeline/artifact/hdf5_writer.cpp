#include <fcntl.h>
#include <unistd.h>
#include <algorithm>

#include <cerrno>
#include <cstdlib>
#include <optional>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/hdf5_handle.h"
#include "pipeline/core/file_error.h"

namespace hbr::inline artifact {
namespace {

constexpr std::size_t kChunkBytes = std::size_t{1} << 20;
constexpr std::size_t kGrowth = std::size_t{1} << 16;  // of the image in memory, in bytes

// Whole rows, as equal as possible, of about kChunkBytes.
std::vector<hsize_t> chunk_shape(const std::vector<std::size_t>& shape, std::size_t bytes) {
  std::vector<hsize_t> chunk(shape.begin(), shape.end());
  const std::size_t chunks = (bytes + kChunkBytes - 1) / kChunkBytes;
  const std::size_t pieces = std::clamp<std::size_t>(chunks, 1, shape[0]);
  chunk[0] = (shape[0] + pieces - 1) / pieces;
  return chunk;
}

}  // namespace

// The file is made in memory and written out by close(): HDF5 can't recover from a disk that fills up while
// it holds a file open. (Its own way of handing out such an image, H5Fget_file_image, breaks the superblock's
// checksum in 1.10; so we own the memory that its driver uses, and keep it when the driver is done.)
struct Hdf5Writer::File {
  std::filesystem::path path;
  int descriptor = -1;
  char* image = nullptr;
  Hdf5Handle id;

  ~File() {
    id = Hdf5Handle();
    std::free(image);
    if (descriptor >= 0) ::close(descriptor);
  }
  // The driver's memory: `file` is the File.
  static void* allocate(std::size_t bytes, H5FD_file_image_op_t, void* file) {
    return static_cast<File*>(file)->image = static_cast<char*>(std::calloc(bytes, 1));
  }
  static void* reallocate(void* old, std::size_t bytes, H5FD_file_image_op_t, void* file) {
    void* grown = std::realloc(old, bytes);
    if (grown) static_cast<File*>(file)->image = static_cast<char*>(grown);
    return grown;
  }
  static herr_t keep(void*, H5FD_file_image_op_t, void*) { return 0; }
  static void* same(void* file) { return file; }
  static herr_t nothing(void*) { return 0; }

  // The length of the image as its superblock (version 3) has it, at byte 28.
  std::size_t length() const {
    HBR_CHECK(image && image[8] == 3, "{}: superblock version {}", path.string(), image ? image[8] : -1);
    std::uint64_t end = 0;
    for (int i = 7; i >= 0; --i) end = end << 8 | static_cast<unsigned char>(image[28 + i]);
    return end;
  }
  [[noreturn]] void fail(const std::string& reason) const {
    throw InputError("{}: can't write this file: {}", path.string(), reason);
  }
  [[noreturn]] void fail_by_system() const { throw file_error(path, "can't write", errno); }
  void check(bool good, const std::string& what) const {
    if (!good) fail(fmt::format("{}: {}", what, hdf5_reason()));
  }
  void write_out() const {
    for (std::size_t at = 0, end = length(); at < end;) {
      const ssize_t written = ::write(descriptor, image + at, end - at);
      if (written < 0 && errno != EINTR) fail_by_system();
      if (written > 0) at += static_cast<std::size_t>(written);
    }
  }
  // The groups above `name`; HDF5's own way of making them would give them time stamps.
  void make_groups(const std::string& name) const {
    const Hdf5Handle creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
    H5Pset_obj_track_times(creation, false);
    for (std::size_t at = name.find('/', 1); at != std::string::npos; at = name.find('/', at + 1)) {
      const std::string group = name.substr(0, at);
      if (H5Lexists(id, group.c_str(), H5P_DEFAULT) > 0) continue;
      const Hdf5Handle made(H5Gcreate2(id, group.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
      check(made.valid(), group);
    }
  }
  // One value, or a list of `count`.
  void attribute(const std::string& of, const std::string& name, std::optional<hsize_t> count,
                 const void* values, hid_t type) const {
    const Hdf5Handle object(H5Oopen(id, of.c_str(), H5P_DEFAULT), H5Oclose);
    const Hdf5Handle space(count ? H5Screate_simple(1, &*count, nullptr) : H5Screate(H5S_SCALAR), H5Sclose);
    const Hdf5Handle made(H5Acreate2(object, name.c_str(), type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    check(made.valid() && (count == 0 || H5Awrite(made, type, values) >= 0), of + ": " + name);
  }
};

Hdf5Writer::Hdf5Writer(const std::filesystem::path& path) : file_(std::make_unique<File>()) {
  hdf5_silence();
  file_->path = path;
  file_->descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file_->descriptor < 0) file_->fail_by_system();
  const Hdf5Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  const Hdf5Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5FD_file_image_callbacks_t memory{File::allocate, nullptr,       File::reallocate, File::keep,
                                     File::same,     File::nothing, file_.get()};
  H5Pset_file_image_callbacks(access, &memory);
  H5Pset_fapl_core(access, kGrowth, false);
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
  H5Pset_obj_track_times(creation, false);
  // HDF5 only notes the name: nothing is written under it.
  file_->id = Hdf5Handle(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access), H5Fclose);
  file_->check(file_->id.valid(), "creating");
}

Hdf5Writer::~Hdf5Writer() = default;

template <class T>
void Hdf5Writer::write(const std::string& name, const std::vector<std::size_t>& shape, const T* values) {
  HBR_CHECK(file_->id.valid(), "{} is closed", file_->path.string());
  HBR_CHECK(!shape.empty(), "{} has no dimension", name);
  std::size_t bytes = sizeof(T);
  for (const std::size_t n : shape) bytes *= n;
  const std::vector<hsize_t> dimensions(shape.begin(), shape.end());
  const int rank = static_cast<int>(shape.size());

  file_->make_groups(name);
  const Hdf5Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);
  if (bytes > 0) {  // an empty array has no chunks
    H5Pset_chunk(creation, rank, chunk_shape(shape, bytes).data());
    H5Pset_fletcher32(creation);
  }
  const Hdf5Handle space(H5Screate_simple(rank, dimensions.data(), nullptr), H5Sclose);
  const Hdf5Handle set(
      H5Dcreate2(file_->id, name.c_str(), hdf5_type<T>(), space, H5P_DEFAULT, creation, H5P_DEFAULT),
      H5Dclose);
  file_->check(set.valid(), name);
  if (bytes > 0)
    file_->check(H5Dwrite(set, hdf5_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) >= 0, name);
}

template void Hdf5Writer::write(const std::string&, const std::vector<std::size_t>&, const float*);
template void Hdf5Writer::write(const std::string&, const std::vector<std::size_t>&, const double*);
template void Hdf5Writer::write(const std::string&, const std::vector<std::size_t>&, const std::uint8_t*);
template void Hdf5Writer::write(const std::string&, const std::vector<std::size_t>&, const std::int32_t*);
template void Hdf5Writer::write(const std::string&, const std::vector<std::size_t>&, const std::int64_t*);

void Hdf5Writer::attribute(const std::string& name, const std::string& value, const std::string& of) {
  const char* text = value.c_str();
  file_->attribute(of, name, std::nullopt, &text, hdf5_text_type());
}

void Hdf5Writer::attribute(const std::string& name, double value, const std::string& of) {
  file_->attribute(of, name, std::nullopt, &value, hdf5_type<double>());
}

void Hdf5Writer::attribute(const std::string& name, std::int64_t value, const std::string& of) {
  file_->attribute(of, name, std::nullopt, &value, hdf5_type<std::int64_t>());
}

void Hdf5Writer::attribute(const std::string& name, const std::vector<std::string>& values,
                           const std::string& of) {
  std::vector<const char*> texts;
  for (const std::string& value : values) texts.push_back(value.c_str());
  file_->attribute(of, name, texts.size(), texts.data(), hdf5_text_type());
}

void Hdf5Writer::attribute(const std::string& name, const std::vector<double>& values,
                           const std::string& of) {
  file_->attribute(of, name, values.size(), values.data(), hdf5_type<double>());
}

void Hdf5Writer::attribute(const std::string& name, const std::vector<std::int64_t>& values,
                           const std::string& of) {
  file_->attribute(of, name, values.size(), values.data(), hdf5_type<std::int64_t>());
}

void Hdf5Writer::close() {
  HBR_CHECK(file_->id.valid(), "{} is closed", file_->path.string());
  file_->check(H5Fflush(file_->id, H5F_SCOPE_GLOBAL) >= 0, "flushing");
  file_->id = Hdf5Handle();
  file_->write_out();
  if (::close(std::exchange(file_->descriptor, -1)) != 0) file_->fail_by_system();
}

}  // namespace hbr::inline artifact
