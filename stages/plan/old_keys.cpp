#include "stages/plan/old_keys.h"

#include <utility>

#include "pipeline/core/check.h"

namespace hbr::inline stages {

void refuse_old_keys(const SettingsSource& profile) {
  constexpr std::pair<const char*, const char*> kOld[] = {
      {"half_side", "defaults.half_side"},
      {"longest_line", "defaults.longest_line"},
      {"line_range", "defaults.line_range"},
      {"search", "the same keys in [defaults]"},
      {"layer1", "[layers.layer1], or [defaults.points] for all points"},
      {"layer2", "[layers.layer2_NAME] for each variant, and [defaults.lines] for what they share"},
      {"reference4d", "[layers.reference4d]"},
      {"layer3",
       "[layers.layer3_NAME] for each variant with `below`, and [defaults.arcs] for what they share"},
      {"flat_arcs", "[layers.flat_arcs]"},
      {"layer4", "[layers.layer4] with `below`"},
      {"flat_digits", "[layers.flat_digits]"},
      {"experiments", "accuracy.requests, arc_quality.fresh_starts and substitution.layer"},
  };
  for (const auto& [old, instead] : kOld) {
    if (!profile.values.contains(old)) continue;
    const auto at = profile.keys.find(std::string("/") + old);
    const std::string where = at == profile.keys.end() ? profile.file
                                                       : fmt::format("{}:{}:{}", at->second.file,
                                                                     at->second.line, at->second.column);
    throw InputError("{}: '{}' is how profiles were written before; write {}", where, old, instead);
  }
}

}  // namespace hbr::inline stages
