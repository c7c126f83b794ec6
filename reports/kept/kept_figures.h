// Figures of a kept run in words.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "reports/kept/kept_run.h"

namespace hbr::inline reports {

// Stands where a run did not measure what is asked for.
inline constexpr const char* kNotMeasured = "–";

// `text` with its places filled from the run, or from one of its variations. Places are those of
// reports/text/template.h, and of the whole run {{value:cpu}} and {{value:disk}}, summed over its stages,
// {{value:memory}}, the most of a stage, {{value:cpu.STAGE}} of a stage and {{value:each.STAGE}} of one of
// its artifacts in the mean, and {{value:verdicts}}, how many counted claims are reproduced, partly,
// undecided and not. kNotMeasured instead of the text where a place asks for what was not measured. Throws
// InputError where it asks for what no run can have, or the variation is none of the run's.
std::string with_figures(const std::string& text, const KeptRun& run, const std::string& variation = "");

// What was kept of the run's statistics, or of its variation's. Throws InputError where it has no such.
const nlohmann::json& statistics_of(const KeptRun& run, const std::string& variation);

}  // namespace hbr::inline reports
