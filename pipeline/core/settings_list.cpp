#include "pipeline/core/settings_list.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

namespace hbr::inline core {

void SettingsLister::choice(const char* key, std::string&, const std::vector<const char*>& allowed,
                            const char* meaning) {
  add(key, fmt::format("{}", fmt::join(allowed, " | ")), meaning);
}

std::string SettingsLister::in_words(Range range, bool whole) {
  const char* kind = whole ? "whole, " : "";
  return std::isinf(range.low) ? "any number" : fmt::format("{}{} to {}", kind, range.low, range.high);
}

}  // namespace hbr::inline core
