// What the bytes of an artifact depend on besides its ingredients.
#pragma once

#include <nlohmann/json.hpp>

namespace hbr::inline artifact {

// Of this build and this machine, all texts:
//   compiler      "GCC 12.2.0", "Clang 14.0.6"
//   flags         those that matter to the code, as given
//   architecture  the instruction set that it was compiled for: "x86-64-v3", "aarch64"
//   processor     the level of the processor it runs on: libraries choose their code by it
//   libraries     those whose code or format the bytes are made by: glibc and HDF5 as they run, the others as
//                 they were found when the programs were built
// Same inputs, programs and toolchain: same bytes.
nlohmann::json toolchain();

}  // namespace hbr::inline artifact
