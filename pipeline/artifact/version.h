// Which sources these are.
#pragma once

#include <filesystem>
#include <string>

namespace hbr::inline artifact {

// What git describes a checkout as ("v1.0-3-g74df34d-dirty"); of an unpacked archive, what its file .version
// was told when git made it; "unknown" where neither is. A repository further up is another's.
std::string version_of(const std::filesystem::path& repository);

}  // namespace hbr::inline artifact
