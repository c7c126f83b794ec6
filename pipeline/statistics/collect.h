// From the artifacts of an experiment to its statistics.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

namespace hbr::inline statistics {

// Artifacts by their names below OUT ("layer2_n10/03.h5"), see pipeline/artifact/FORMAT.md; and the names of
// the profile's layers, which may be any. What is not there is not in the result; table.h describes it.
// Throws InputError where a name or a file is not as described.
nlohmann::json collect_statistics(const std::string& profile,
                                  const std::map<std::string, std::filesystem::path>& artifacts,
                                  const std::set<std::string>& layers = {});

}  // namespace hbr::inline statistics
