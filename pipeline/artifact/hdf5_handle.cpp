#include "pipeline/artifact/hdf5_handle.h"

#include <algorithm>

namespace hbr::inline artifact {

Hdf5Handle hdf5_open(const std::filesystem::path& path) {
  // Made once: closing it after an open that failed would clear the reason.
  static const Hdf5Handle access = [] {
    Hdf5Handle made(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
    H5Pset_file_locking(made, false, true);
    return made;
  }();
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose};
}

void hdf5_silence() { H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr); }

std::string hdf5_reason() {
  std::string reason;
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned n, const H5E_error2_t* error, void* text) -> herr_t {
        if (n == 0 && error->desc) *static_cast<std::string*>(text) = error->desc;
        return 0;
      },
      &reason);
  std::replace(reason.begin(), reason.end(), '\n', ' ');
  return reason.empty() ? "no reason given" : reason;
}

}  // namespace hbr::inline artifact
