// readings.json (study.h), read strictly.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace hbr::inline reports {

// Throws InputError, "FILE: runs.0.levels: expected ..., found ...", where it is not as described in study.h.
nlohmann::json read_study(const std::filesystem::path& file);

}  // namespace hbr::inline reports
