// Tables of kinds, each with a name and a meaning.
#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "pipeline/core/check.h"

namespace hbr::inline qd {

template <class Kinds>
std::vector<const char*> names_of(const Kinds& kinds) {
  std::vector<const char*> names;
  for (const auto& kind : kinds) names.push_back(kind.name);
  return names;
}

// "grid: MAP-Elites; cvt: CVT-MAP-Elites"
template <class Kinds>
std::string meanings_of(const Kinds& kinds) {
  std::vector<std::string> meanings;
  for (const auto& kind : kinds) meanings.push_back(fmt::format("{}: {}", kind.name, kind.meaning));
  return fmt::format("{}", fmt::join(meanings, "; "));
}

// Throws InputError where no kind has the name.
template <class Kinds>
const auto& named(const Kinds& kinds, const std::string& name, const char* what) {
  for (const auto& kind : kinds)
    if (kind.name == name) return kind;
  throw InputError("{} '{}': expected one of {}", what, name, fmt::join(names_of(kinds), ", "));
}

}  // namespace hbr::inline qd
