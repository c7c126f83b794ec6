// Which sources these are.
#pragma once

#include <filesystem>
#include <string>

namespace hbr::inline artifact {

// The release and the commit ("1.0.0+74df34d-dirty", as semantic versioning writes it). The release is what
// CITATION.cff says, the one place of it. The commit is what git says of a checkout, "-dirty" where files
// differ from it, or what .version says in an archive, which git writes when it makes the archive; a
// repository further up is another's. Either is "unknown" where nobody says it.
std::string version_of(const std::filesystem::path& repository);

}  // namespace hbr::inline artifact
