// How fast it is: the benchmarks' results, condensed to a table that is kept with the sources and shown in
// the report.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hbr::inline reports {

// `rows` is tests/benchmarks.toml, `results` what Google Benchmark wrote (--benchmark_out). Of repetitions
// the fastest counts, which others on the machine disturbed least. Returns
//
//   machine, compiler, flags, architecture   where it was measured (pipeline/artifact/toolchain.h)
//   peers_from                               where the peers' rates come from
//   rows  [{what, item, rate, against, reference_rate, with: {counter: value},
//           peers: [{name, rate}]}]   rates are items per CPU second of one thread
//
// A row without results is left out and a reference without results is null, unless the `whole` table is
// asked for. Throws InputError where a file is not as described or something is missing from the whole.
nlohmann::json condense_speed(const std::filesystem::path& rows,
                              const std::vector<std::filesystem::path>& results, bool whole);

// The table as it is kept, or null. Throws InputError where the file is not as described above.
nlohmann::json read_speed(const std::filesystem::path& file);

// As in a README. The same table as HTML, with a sentence on where it was measured; null says that there is
// none. Both throw InputError where `speed` is not as above.
std::string speed_markdown(const nlohmann::json& speed);
std::string speed_html(const nlohmann::json& speed);

}  // namespace hbr::inline reports
