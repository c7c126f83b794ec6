// The selectors by name, as a profile calls them. To add one: its class, and its row in selectors.cpp.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "pipeline/qd/selector.h"

namespace hbr::inline qd {

struct SelectorSettings {
  int descriptor_size;  // 1 to 8
  int neighbours;       // k of scores that look at neighbours, 1 to kMaxNeighbours
  float low, high;      // range of the descriptor, the same in every dimension
};

struct SelectorKind {
  const char* name;
  const char* meaning;
  std::unique_ptr<Selector> (*make)(const SelectorSettings& settings);
};

std::span<const SelectorKind> selector_kinds();
// Throws InputError for another name.
const SelectorKind& selector_kind(const std::string& name);

}  // namespace hbr::inline qd
