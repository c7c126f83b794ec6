// What an artifact was made from, and what that was made from, by the manifests beside them.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "pipeline/artifact/manifest.h"

namespace hbr::inline reports {

// The manifests of the artifact and of its ancestors, by their outputs ("layer1/00.h5"). Throws InputError
// where one is missing or not as a run left it.
std::map<std::string, Manifest> lineage(const std::filesystem::path& out, const std::string& output);

}  // namespace hbr::inline reports
