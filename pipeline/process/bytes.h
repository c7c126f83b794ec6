// Bytes through open files and pipes, whole.
#pragma once

#include <string>

namespace hbr::inline process {

// Whether all of it was written; errno says why not.
bool write_all(int file, const std::string& text);

// Up to the end.
std::string read_all(int file);

}  // namespace hbr::inline process
