// What the system says of a file, and what a user can do about it.
#pragma once

#include <filesystem>

#include "pipeline/core/check.h"

namespace hbr::inline core {

// "PATH: can't write: No space left on device; make room or give another OUT". `error` is an errno of the
// path.
InputError file_error(const std::filesystem::path& path, const char* what, int error);

// The same of what std::filesystem threw.
InputError file_error(const std::filesystem::filesystem_error& error);

}  // namespace hbr::inline core
