// What statistics mean, in tables that each name a family's measures.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pipeline/statistics/names.h"

namespace hbr::inline statistics {

// {} in a meaning stands for the subject: the layer, its variant, the robot.
struct Entry {
  const char* name;
  const char* unit;
  const char* text;
};

template <std::size_t N>
const Entry* find_entry(const std::array<Entry, N>& entries, std::string_view name) {
  const auto found = std::ranges::find(entries, name, &Entry::name);
  return found == entries.end() ? nullptr : &*found;
}

inline Meaning make(const Entry& entry, const std::string& subject) {
  return {entry.unit, fmt::format(fmt::runtime(entry.text), subject)};
}

inline bool is_number(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

// "layer2" -> "layer 2 (lines)"; "" for what is no search.
std::string search_words(const std::string& head);

// Of the words of a name: what other robots made of the arm's layers. Nothing for all other names.
std::optional<Meaning> meaning_of_robots(const std::vector<std::string>& parts);

}  // namespace hbr::inline statistics
