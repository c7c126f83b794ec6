// The PROFILE of a command line: a name, or a file.
#pragma once

#include <filesystem>
#include <string>

namespace hbr::inline stages {

// The file of a profile: FOLDER/NAME.toml for a plain name; what has a slash in it or ends in .toml is a file
// itself (its .toml may be left out). Throws InputError where there is none.
std::filesystem::path profile_file(const std::string& word, const std::filesystem::path& folder);

}  // namespace hbr::inline stages
