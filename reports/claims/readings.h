// The ledger of readings: what the paper leaves open and how it was read.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace hbr::inline reports {

// reports/readings.toml as an array of {id, title, paper, reading, alternatives, effect, option}, all texts.
// Throws InputError where a key is missing or unknown, a text other than `option` is empty, or an id is given
// twice.
nlohmann::json read_readings(const std::filesystem::path& path);

}  // namespace hbr::inline reports
