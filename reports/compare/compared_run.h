// A run as it is compared with another: whatever is there of it, finished or not.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/artifact/manifest.h"

namespace hbr::inline reports {

struct ComparedRun {
  std::filesystem::path out;
  std::string profile;                               // its name, "" where no statistics say it
  std::map<std::string, Manifest> manifests;         // by the artifacts' places below OUT
  std::map<std::string, nlohmann::json> statistics;  // the run's under "", and each variation's
  nlohmann::json claims = nlohmann::json::array();   // claims.json; empty where there is no page
  std::vector<std::string> missing;                  // what is not there or damaged, a sentence each
};

// Throws InputError where the folder is missing or holds no artifact with a manifest.
ComparedRun read_compared_run(const std::filesystem::path& out);

}  // namespace hbr::inline reports
