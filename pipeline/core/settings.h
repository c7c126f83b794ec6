// Settings: a struct whose fields are described once, and from that description read strictly from a profile
// (TOML, see profile.h), written as canonical JSON (a stage's slice) and read back from it.
//
//   struct SearchSettings {
//     int generations = 0;
//     double spacing = 0;
//     std::string selector;
//   };
//   template <class Fields>
//   void describe(Fields& f, SearchSettings& s) {
//     f.number("generations", s.generations, Range{1, 1e9}, "generations of the search");
//     f.number("spacing", s.spacing, Range{1e-6, 1}, "l: least distance between elites, in descriptor
//     units"); f.choice("selector", s.selector, {"curiosity", "uniform"}, "how parents are drawn");
//   }
//
// Other kinds of field: f.flag(key, bool&, meaning), f.text(key, std::string&, meaning),
// f.numbers(key, std::vector<double or int>&, Range, meaning), f.texts(key, std::vector<std::string>&,
// meaning), f.table(key, Struct&, meaning) and f.tables(key, std::vector<Struct>&, meaning) for nested
// structs, f.optional_tables(...) for one that may be left out and then has none, f.named_texts(key,
// std::map<std::string, std::string>&, meaning) for a table of texts whose keys may be any, f.raw_table(key,
// nlohmann::json&, meaning) for a table that is read elsewhere. number() takes int, std::int64_t,
// std::uint64_t or double members; an integer member refuses a fraction. Every other key of a description is
// required and no other is allowed, so a profile says all there is to know.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace hbr::inline core {

struct Range {
  double low;   // inclusive
  double high;  // inclusive
};

// A tree of values and where each of them stands in its file.
struct SettingsSource {
  struct Position {
    std::string file;
    std::size_t line = 0, column = 0;
  };
  nlohmann::json values;
  std::string file;                        // leads every error about what has no position
  std::map<std::string, Position> keys;    // by JSON pointer; empty for a source without lines
  std::map<std::string, Position> places;  // the same of the values
};

// Reads the fields of one table. Every error is an InputError of one line: where, key, expected, found.
class SettingsReader {
 public:
  SettingsReader(const SettingsSource& source, const nlohmann::json& table, std::string pointer)
      : source_(source), table_(table), pointer_(std::move(pointer)) {}

  void number(const char* key, int& value, Range range, const char* meaning);
  void number(const char* key, std::int64_t& value, Range range, const char* meaning);
  void number(const char* key, std::uint64_t& value, Range range, const char* meaning);
  void number(const char* key, double& value, Range range, const char* meaning);
  void flag(const char* key, bool& value, const char* meaning);
  void text(const char* key, std::string& value, const char* meaning);
  void choice(const char* key, std::string& value, const std::vector<const char*>& allowed,
              const char* meaning);
  void numbers(const char* key, std::vector<double>& value, Range range, const char* meaning);
  void numbers(const char* key, std::vector<int>& value, Range range, const char* meaning);
  void texts(const char* key, std::vector<std::string>& value, const char* meaning);
  void named_texts(const char* key, std::map<std::string, std::string>& value, const char* meaning);
  void raw_table(const char* key, nlohmann::json& value, const char* meaning);
  // Of files that are no settings: nothing where the key is missing or null.
  void optional_number(const char* key, std::optional<double>& value, Range range, const char* meaning);
  void named_numbers(const char* key, std::map<std::string, double>& value, Range range, const char* meaning);
  // Each of the list may be null.
  void optional_numbers(const char* key, std::vector<std::optional<double>>& value, Range range,
                        const char* meaning);
  void lists_of_numbers(const char* key, std::vector<std::vector<double>>& value, Range range,
                        const char* meaning);
  template <class S>
  void optional_table(const char* key, std::optional<S>& value, const char* meaning) {
    known_.emplace_back(key);
    value.reset();
    if (const auto found = table_.find(key); found != table_.end() && !found->is_null())
      read_table(*found, pointer_ + "/" + key, value.emplace(), meaning);
  }

  template <class S>
  void table(const char* key, S& value, const char* meaning) {
    if (const nlohmann::json* found = find(key, meaning))
      read_table(*found, pointer_ + "/" + key, value, meaning);
  }
  template <class S>
  void tables(const char* key, std::vector<S>& value, const char* meaning) {
    const nlohmann::json* found = find_list(key, meaning);
    value.assign(found ? found->size() : 0, S{});
    for (std::size_t i = 0; i < value.size(); ++i)
      read_table((*found)[i], pointer_ + "/" + key + "/" + std::to_string(i), value[i], meaning);
  }

  // None where the key is missing.
  template <class S>
  void optional_tables(const char* key, std::vector<S>& value, const char* meaning) {
    if (table_.is_object() && table_.contains(key)) tables(key, value, meaning);
  }

  template <class S>
  void named_tables(const char* key, std::map<std::string, S>& value, const char* meaning) {
    const nlohmann::json* found = find_table(key, meaning);
    value.clear();
    if (found)
      for (const auto& [name, table] : found->items())
        read_table(table, pointer_ + "/" + key + "/" + name, value[name], meaning);
  }

  // All of the table.
  template <class S>
  S whole() {
    require_table(table_, pointer_, "the whole of it");
    S value{};
    describe(*this, value);
    finish();
    return value;
  }

 private:
  // Complains about keys that the description does not know, then about those it misses.
  void finish() const;
  const nlohmann::json* find(const char* key, const char* meaning);
  const nlohmann::json* find_list(const char* key, const char* meaning);
  const nlohmann::json* find_table(const char* key, const char* meaning);
  void require_table(const nlohmann::json& found, const std::string& pointer, const char* meaning) const;
  template <class T>
  T checked_number(const nlohmann::json& found, const std::string& pointer, Range range,
                   const char* meaning) const;
  template <class T>
  void read_number(const char* key, T& value, Range range, const char* meaning);
  template <class T>
  std::vector<T> checked_numbers(const nlohmann::json& list, const std::string& pointer, Range range,
                                 const char* meaning) const;
  [[noreturn]] void fail(const std::string& pointer, const std::string& expected, const nlohmann::json& found,
                         const std::string& hint = "") const;

  template <class S>
  void read_table(const nlohmann::json& found, const std::string& pointer, S& value, const char* meaning) {
    require_table(found, pointer, meaning);
    value = SettingsReader(source_, found, pointer).whole<S>();
  }

  const SettingsSource& source_;
  const nlohmann::json& table_;
  std::string pointer_;
  std::vector<std::string> known_;
  std::vector<std::pair<std::string, std::string>> missing_;  // key, meaning
};

// Writes the fields of one table.
class SettingsWriter {
 public:
  template <class T>
  void number(const char* key, T& value, Range, const char*) {
    table_[key] = value;
  }
  void flag(const char* key, bool& value, const char*) { table_[key] = value; }
  void text(const char* key, std::string& value, const char*) { table_[key] = value; }
  void choice(const char* key, std::string& value, const std::vector<const char*>&, const char*) {
    table_[key] = value;
  }
  template <class T>
  void numbers(const char* key, std::vector<T>& value, Range, const char*) {
    table_[key] = value;
  }
  void texts(const char* key, std::vector<std::string>& value, const char*) { table_[key] = value; }
  void named_texts(const char* key, std::map<std::string, std::string>& value, const char*) {
    table_[key] = value;
  }
  void raw_table(const char* key, nlohmann::json& value, const char*) { table_[key] = value; }
  template <class S>
  void table(const char* key, S& value, const char*) {
    table_[key] = written(value);
  }
  template <class S>
  void tables(const char* key, std::vector<S>& value, const char*) {
    table_[key] = nlohmann::json::array();
    for (S& each : value) table_[key].push_back(written(each));
  }
  template <class S>
  void optional_tables(const char* key, std::vector<S>& value, const char* meaning) {
    if (!value.empty()) tables(key, value, meaning);
  }

  template <class S>
  static nlohmann::json written(S& value) {
    SettingsWriter writer;
    describe(writer, value);
    return std::move(writer.table_);
  }

 private:
  nlohmann::json table_ = nlohmann::json::object();
};

// `where` leads the errors: the file or artifact the settings come from.
template <class S>
S settings_from_source(const SettingsSource& source) {
  return SettingsReader(source, source.values, "").template whole<S>();
}

template <class S>
S settings_from_json(const nlohmann::json& values, const std::string& where) {
  return settings_from_source<S>(SettingsSource{values, where, {}, {}});
}

// Canonical: dump() of equal settings is the same text (sorted keys, shortest numbers that read back
// exactly).
template <class S>
nlohmann::json settings_to_json(S settings) {
  return SettingsWriter::written(settings);
}

// The candidate nearest to `word` by edit distance, as " (did you mean 'x'?)"; empty where none is near.
std::string did_you_mean(const std::string& word, const std::vector<std::string>& candidates);

}  // namespace hbr::inline core
