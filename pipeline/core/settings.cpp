#include "pipeline/core/settings.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <type_traits>

#include "pipeline/core/check.h"

namespace hbr::inline core {
namespace {

std::string dotted(const std::string& pointer) {
  std::string name = pointer.empty() ? "" : pointer.substr(1);
  std::replace(name.begin(), name.end(), '/', '.');
  return name;
}

std::string place(const SettingsSource& source,
                  const std::map<std::string, SettingsSource::Position>& positions,
                  const std::string& pointer) {
  const auto found = positions.find(pointer);
  if (found == positions.end()) return source.file;
  return fmt::format("{}:{}:{}", found->second.file, found->second.line, found->second.column);
}

std::string shown(const nlohmann::json& value) {
  if (value.is_object()) return "a table";
  if (value.is_null()) return "nothing, a date or a time";
  if (value.is_number_float()) return fmt::format("{}", value.get<double>());  // JSON has no word for nan
  std::string text = value.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  if (text.size() > 60) text = text.substr(0, 57) + "...";
  return text;
}

std::string in_range(const char* kind, Range range) {
  if (std::isinf(range.low) && std::isinf(range.high)) return kind;
  return fmt::format("{} from {:.12g} to {:.12g}", kind, range.low, range.high);
}

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i);
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, changed});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates) {
  const std::string* best = nullptr;
  std::size_t least = std::max<std::size_t>(2, word.size() / 3) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(word, candidate);
    if (distance < least) {
      least = distance;
      best = &candidate;
    }
  }
  return best ? fmt::format(" (did you mean '{}'?)", *best) : "";
}

void SettingsReader::fail(const std::string& pointer, const std::string& expected,
                          const nlohmann::json& found, const std::string& hint) const {
  throw InputError("{}: {}{}expected {}, found {}{}", place(source_, source_.places, pointer),
                   dotted(pointer), pointer.empty() ? "" : ": ", expected, shown(found), hint);
}

const nlohmann::json* SettingsReader::find(const char* key, const char* meaning) {
  known_.emplace_back(key);
  const auto found = table_.find(key);
  if (found != table_.end()) return &*found;
  missing_.emplace_back(key, meaning);
  return nullptr;
}

const nlohmann::json* SettingsReader::find_list(const char* key, const char* meaning) {
  const nlohmann::json* found = find(key, meaning);
  if (found && !found->is_array()) fail(pointer_ + "/" + key, fmt::format("a list ({})", meaning), *found);
  return found;
}

const nlohmann::json* SettingsReader::find_table(const char* key, const char* meaning) {
  const nlohmann::json* found = find(key, meaning);
  if (found) require_table(*found, pointer_ + "/" + key, meaning);
  return found;
}

void SettingsReader::require_table(const nlohmann::json& found, const std::string& pointer,
                                   const char* meaning) const {
  if (!found.is_object()) fail(pointer, fmt::format("a table ({})", meaning), found);
}

void SettingsReader::finish() const {
  std::vector<std::string> candidates = known_;
  if (!missing_.empty()) {  // a misspelt key is most likely one of those that are missing
    candidates.clear();
    for (const auto& [key, meaning] : missing_) candidates.push_back(key);
  }
  for (const auto& [key, value] : table_.items())
    if (std::find(known_.begin(), known_.end(), key) == known_.end()) {
      const std::string pointer = pointer_ + "/" + key;
      throw InputError("{}: unknown key '{}'{}", place(source_, source_.keys, pointer), dotted(pointer),
                       did_you_mean(key, candidates));
    }
  if (!missing_.empty()) {
    std::vector<std::string> others;
    for (std::size_t i = 1; i < missing_.size(); ++i)
      others.push_back(fmt::format("'{}' ({})", missing_[i].first, missing_[i].second));
    const std::string pointer = pointer_ + "/" + missing_[0].first;
    throw InputError("{}: missing key '{}' ({}){}{}", place(source_, source_.places, pointer_),
                     dotted(pointer), missing_[0].second, others.empty() ? "" : ", and of the same table ",
                     fmt::join(others, ", "));
  }
}

template <class T>
T SettingsReader::checked_number(const nlohmann::json& found, const std::string& pointer, Range range,
                                 const char* meaning) const {
  constexpr bool whole = std::is_integral_v<T>;
  const std::string expected =
      fmt::format("{} ({})", in_range(whole ? "a whole number" : "a number", range), meaning);
  if (whole ? !found.is_number_integer() : !found.is_number()) fail(pointer, expected, found);
  const double value = found.get<double>();
  if (!(value >= range.low && value <= range.high) || !std::isfinite(value)) fail(pointer, expected, found);
  if constexpr (whole) {
    const bool fits =
        found.is_number_unsigned()
            ? found.get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<T>::max())
            : std::is_signed_v<T> &&
                  found.get<std::int64_t>() >= static_cast<std::int64_t>(std::numeric_limits<T>::min()) &&
                  (found.get<std::int64_t>() < 0 ||
                   found.get<std::uint64_t>() <= static_cast<std::uint64_t>(std::numeric_limits<T>::max()));
    if (!fits) fail(pointer, expected, found);
  }
  return found.get<T>();
}

template <class T>
void SettingsReader::read_number(const char* key, T& value, Range range, const char* meaning) {
  if (const nlohmann::json* found = find(key, meaning))
    value = checked_number<T>(*found, pointer_ + "/" + key, range, meaning);
}

template <class T>
std::vector<T> SettingsReader::checked_numbers(const nlohmann::json& list, const std::string& pointer,
                                               Range range, const char* meaning) const {
  std::vector<T> numbers;
  for (std::size_t i = 0; i < list.size(); ++i)
    numbers.push_back(checked_number<T>(list[i], pointer + "/" + std::to_string(i), range, meaning));
  return numbers;
}

void SettingsReader::number(const char* key, int& value, Range range, const char* meaning) {
  read_number(key, value, range, meaning);
}
void SettingsReader::number(const char* key, std::int64_t& value, Range range, const char* meaning) {
  read_number(key, value, range, meaning);
}
void SettingsReader::number(const char* key, std::uint64_t& value, Range range, const char* meaning) {
  read_number(key, value, range, meaning);
}
void SettingsReader::number(const char* key, double& value, Range range, const char* meaning) {
  read_number(key, value, range, meaning);
}
void SettingsReader::numbers(const char* key, std::vector<double>& value, Range range, const char* meaning) {
  const nlohmann::json* found = find_list(key, meaning);
  value =
      found ? checked_numbers<double>(*found, pointer_ + "/" + key, range, meaning) : std::vector<double>();
}
void SettingsReader::numbers(const char* key, std::vector<int>& value, Range range, const char* meaning) {
  const nlohmann::json* found = find_list(key, meaning);
  value = found ? checked_numbers<int>(*found, pointer_ + "/" + key, range, meaning) : std::vector<int>();
}

void SettingsReader::flag(const char* key, bool& value, const char* meaning) {
  const nlohmann::json* found = find(key, meaning);
  if (!found) return;
  if (!found->is_boolean()) fail(pointer_ + "/" + key, fmt::format("true or false ({})", meaning), *found);
  value = found->get<bool>();
}

void SettingsReader::text(const char* key, std::string& value, const char* meaning) {
  const nlohmann::json* found = find(key, meaning);
  if (!found) return;
  if (!found->is_string()) fail(pointer_ + "/" + key, fmt::format("a text ({})", meaning), *found);
  value = found->get<std::string>();
}

void SettingsReader::choice(const char* key, std::string& value, const std::vector<const char*>& allowed,
                            const char* meaning) {
  const nlohmann::json* found = find(key, meaning);
  if (!found) return;
  const std::vector<std::string> names(allowed.begin(), allowed.end());
  const std::string expected = fmt::format("one of \"{}\" ({})", fmt::join(names, "\", \""), meaning);
  if (!found->is_string()) fail(pointer_ + "/" + key, expected, *found);
  value = found->get<std::string>();
  if (std::find(names.begin(), names.end(), value) == names.end())
    fail(pointer_ + "/" + key, expected, *found, did_you_mean(value, names));
}

void SettingsReader::texts(const char* key, std::vector<std::string>& value, const char* meaning) {
  const nlohmann::json* found = find_list(key, meaning);
  value.clear();
  for (std::size_t i = 0; found && i < found->size(); ++i) {
    const nlohmann::json& each = (*found)[i];
    if (!each.is_string())
      fail(pointer_ + "/" + key + "/" + std::to_string(i), fmt::format("a text ({})", meaning), each);
    value.push_back(each.get<std::string>());
  }
}

void SettingsReader::named_texts(const char* key, std::map<std::string, std::string>& value,
                                 const char* meaning) {
  const nlohmann::json* found = find_table(key, meaning);
  if (!found) return;
  value.clear();
  for (const auto& [name, text] : found->items()) {
    if (!text.is_string()) fail(pointer_ + "/" + key + "/" + name, fmt::format("a text ({})", meaning), text);
    value[name] = text.get<std::string>();
  }
}

void SettingsReader::named_numbers(const char* key, std::map<std::string, double>& value, Range range,
                                   const char* meaning) {
  const nlohmann::json* found = find_table(key, meaning);
  if (!found) return;
  value.clear();
  for (const auto& [name, number] : found->items())
    value[name] = checked_number<double>(number, pointer_ + "/" + key + "/" + name, range, meaning);
}

void SettingsReader::optional_number(const char* key, std::optional<double>& value, Range range,
                                     const char* meaning) {
  known_.emplace_back(key);
  value.reset();
  if (const auto found = table_.find(key); found != table_.end() && !found->is_null())
    value = checked_number<double>(*found, pointer_ + "/" + key, range, meaning);
}

void SettingsReader::optional_numbers(const char* key, std::vector<std::optional<double>>& value, Range range,
                                      const char* meaning) {
  const nlohmann::json* found = find_list(key, meaning);
  value.assign(found ? found->size() : 0, std::nullopt);
  for (std::size_t i = 0; i < value.size(); ++i)
    if (!(*found)[i].is_null())
      value[i] =
          checked_number<double>((*found)[i], pointer_ + "/" + key + "/" + std::to_string(i), range, meaning);
}

void SettingsReader::lists_of_numbers(const char* key, std::vector<std::vector<double>>& value, Range range,
                                      const char* meaning) {
  const nlohmann::json* found = find_list(key, meaning);
  value.clear();
  for (std::size_t i = 0; found && i < found->size(); ++i) {
    const std::string pointer = pointer_ + "/" + key + "/" + std::to_string(i);
    if (!(*found)[i].is_array()) fail(pointer, fmt::format("a list ({})", meaning), (*found)[i]);
    value.push_back(checked_numbers<double>((*found)[i], pointer, range, meaning));
  }
}

void SettingsReader::raw_table(const char* key, nlohmann::json& value, const char* meaning) {
  if (const nlohmann::json* found = find_table(key, meaning)) value = *found;
}

}  // namespace hbr::inline core
