#include "pipeline/artifact/json_file.h"

#include <fmt/ranges.h>

#include <set>
#include <vector>

#include "pipeline/artifact/content.h"
#include "pipeline/core/check.h"

namespace hbr::inline artifact {
namespace {

using nlohmann::json;

constexpr const char* kSeal = "seal";
constexpr int kDeepest = 64;  // nothing of ours is a tenth of that

// Watches the parser go by: it takes the last of two equal keys without a word, and any depth.
class Watch {
 public:
  explicit Watch(const std::string& where) : where_(where) {}

  bool operator()(int depth, json::parse_event_t event, json& parsed) {
    if (depth > kDeepest)
      throw InputError("{}: nested more than {} deep; expected a file that this project wrote", where_,
                       kDeepest);
    if (event == json::parse_event_t::object_start) open_.emplace_back();
    if (event == json::parse_event_t::object_end) open_.pop_back();
    if (event == json::parse_event_t::key && !open_.back().insert(parsed.get<std::string>()).second)
      throw InputError("{}: the key {} stands twice in one table; expected it once", where_, parsed.dump());
    return true;
  }

 private:
  const std::string& where_;
  std::vector<std::set<std::string>> open_;  // the keys of each table that is not closed yet
};

// "[json.exception.parse_error.101] parse error at line 1, column 2: ..." without what tells a user nothing.
std::string reason(const json::exception& error) {
  const std::string text = error.what(), lead = "parse error";
  const std::size_t at = text.find(lead);
  return at != std::string::npos ? text.substr(at + lead.size() + 1) : text.substr(text.find("] ") + 2);
}

}  // namespace

json parse_json(std::string_view text, const std::string& where) {
  try {
    return json::parse(text, Watch(where));
  } catch (const json::exception& error) {
    throw InputError("{}: not JSON: {}", where, reason(error));
  }
}

json read_json(const std::filesystem::path& file) { return parse_json(read_whole(file), file.string()); }

json sealed(json table) {
  table.erase(kSeal);
  table[kSeal] = sha256_of_text(table.dump());
  return table;
}

json unsealed(json table, const std::string& where) {
  if (!table.is_object() || !table.contains(kSeal))
    throw InputError("{}: expected a table with the key '{}'", where, kSeal);
  const json found = table[kSeal];
  table = sealed(std::move(table));
  if (table[kSeal] != found)
    throw InputError(
        "{}: edited or damaged since it was written: its '{}' is not the hash of its other values", where,
        kSeal);
  table.erase(kSeal);
  return table;
}

}  // namespace hbr::inline artifact
