// The keys of settings, from the description by which they are read (settings.h): what people may write.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pipeline/core/settings.h"

namespace hbr::inline core {

struct SettingsKey {
  std::string name;      // "spacing", "pencil.framing", "robots[].name"
  std::string expected;  // "0.0001 to 10", "distance | grid", "text"
  std::string meaning;
};

class SettingsLister {
 public:
  template <class T>
  void number(const char* key, T&, Range range, const char* meaning) {
    add(key, in_words(range, std::is_integral_v<T>), meaning);
  }
  void flag(const char* key, bool&, const char* meaning) { add(key, "true | false", meaning); }
  void text(const char* key, std::string&, const char* meaning) { add(key, "text", meaning); }
  void choice(const char* key, std::string&, const std::vector<const char*>& allowed, const char* meaning);
  template <class T>
  void numbers(const char* key, std::vector<T>&, Range range, const char* meaning) {
    add(key, "list, " + in_words(range, std::is_integral_v<T>), meaning);
  }
  void texts(const char* key, std::vector<std::string>&, const char* meaning) {
    add(key, "list of texts", meaning);
  }
  void named_texts(const char* key, std::map<std::string, std::string>&, const char* meaning) {
    add(key, "table of texts", meaning);
  }
  void raw_table(const char* key, nlohmann::json&, const char* meaning) { add(key, "table", meaning); }
  template <class S>
  void table(const char* key, S&, const char*) {
    append<S>(std::string(key) + ".");
  }
  template <class S>
  void tables(const char* key, std::vector<S>&, const char*) {
    append<S>(std::string(key) + "[].");
  }
  template <class S>
  void optional_tables(const char* key, std::vector<S>& value, const char* meaning) {
    tables(key, value, meaning);
  }

  template <class S>
  static std::vector<SettingsKey> listed() {
    SettingsLister lister;
    S settings{};
    describe(lister, settings);
    return std::move(lister.keys_);
  }

 private:
  static std::string in_words(Range range, bool whole);
  void add(const char* key, std::string expected, const char* meaning) {
    keys_.push_back({key, std::move(expected), meaning});
  }
  template <class S>
  void append(const std::string& prefix) {
    for (SettingsKey& key : listed<S>()) keys_.push_back({prefix + key.name, key.expected, key.meaning});
  }

  std::vector<SettingsKey> keys_;
};

template <class S>
std::vector<SettingsKey> settings_keys() {
  return SettingsLister::listed<S>();
}

}  // namespace hbr::inline core
