// Every way in which a JSON file is found damaged: a value of another type at each place, a key less or more
// at each table, and texts that are no JSON, or more than one thing at once.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace hbr {

using Damage = std::pair<std::string, std::string>;  // what was done, the text that it left

namespace detail {

inline void add_damages(const nlohmann::json& root, const nlohmann::json& value, const std::string& pointer,
                        std::vector<Damage>& all) {
  using nlohmann::json;
  const auto with = [&](const std::string& what, auto&& change) {
    json copy = root;
    change(copy[json::json_pointer(pointer)]);
    if (copy != root) all.emplace_back(pointer + " " + what, copy.dump(1));
  };
  for (const json& other :
       {json(), json(true), json(-1), json(1.5), json(1e300), json(18446744073709551615u), json("x"),
        json(""), json::array(), json::object(), json{{"x", {1, "x"}}}, json{"x", 1, nullptr}})
    with("is " + other.dump(), [&](json& place) { place = other; });
  if (value.is_object()) {
    with("has one key more", [](json& place) { place["unknown"] = 1; });
    for (const auto& [key, inner] : value.items()) {
      const std::string name = key;
      with("lacks " + name, [&](json& place) { place.erase(name); });
    }
  }
  if (value.is_structured())
    for (const auto& [key, inner] : value.items()) {
      std::string escaped;
      for (const char c : key) escaped += c == '~' ? "~0" : c == '/' ? "~1" : std::string(1, c);
      add_damages(root, inner, pointer + "/" + escaped, all);
    }
}

}  // namespace detail

// Of a text that holds an object or a list.
inline std::vector<Damage> damages_of(const std::string& text) {
  const nlohmann::json root = nlohmann::json::parse(text);
  std::vector<Damage> all;
  detail::add_damages(root, root, "", all);
  for (const std::size_t tenths : {0u, 1u, 5u, 9u})
    all.emplace_back("cut short", text.substr(0, text.size() * tenths / 10));
  const std::string inside = text.substr(1);
  if (root.is_object() && !root.empty()) {
    const std::string first = nlohmann::json(root.begin().key()).dump() + ": " + root.begin()->dump();
    all.emplace_back("a key twice", "{" + first + ", " + inside);
  }
  const char open = text[0];
  const std::string key = open == '{' ? "\"x\": " : "";
  for (const char* value : {"NaN", "Infinity", "1e999", "-1e999", "\"\xff\"", "\"\xc3(\"", "'x'", "01", "+1",
                            "\"\\ud800\"", "\"a\nb\""})
    all.emplace_back(std::string("holds ") + value, open + key + value + ", " + inside);
  all.emplace_back("something behind it", text + "x");
  all.emplace_back("twice", text + text);
  all.emplace_back("deep", std::string(100'000, '['));
  all.emplace_back("deep in it",
                   open + key + std::string(200'000, '[') + std::string(200'000, ']') + ", " + inside);
  all.emplace_back("a zero byte in it", open + std::string(1, '\0') + inside);
  all.emplace_back("no JSON", "profile = 1\n");
  return all;
}

}  // namespace hbr
