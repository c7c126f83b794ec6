#include "pipeline/core/json_text.h"

#include <set>
#include <vector>

#include "pipeline/core/check.h"

namespace hbr::inline core {
namespace {

using nlohmann::json;

constexpr int kDeepest = 64;  // nothing of ours is a tenth of that

// Watches the parser go by: it takes the last of two equal keys without a word, and any depth.
class Watch {
 public:
  explicit Watch(const std::string& where) : where_(where) {}

  bool operator()(int depth, json::parse_event_t event, json& parsed) {
    if (depth > kDeepest)
      throw InputError("{}: nested more than {} deep; expected less, as a sound file has", where_, kDeepest);
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

}  // namespace hbr::inline core
