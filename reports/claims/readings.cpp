#include "reports/claims/readings.h"

#include <set>
#include <string>
#include <vector>

#include "pipeline/artifact/profile.h"
#include "pipeline/core/check.h"

namespace hbr::inline reports {

struct Reading {
  std::string id, title, paper, reading, alternatives, effect, option;
};
template <class Fields>
void describe(Fields& f, Reading& r) {
  f.text("id", r.id, "unique");
  f.text("title", r.title, "what was open");
  f.text("paper", r.paper, "what the paper says");
  f.text("reading", r.reading, "what is done here");
  f.text("alternatives", r.alternatives, "what else could be meant");
  f.text("effect", r.effect, "what is known of the difference");
  f.text("option", r.option, "the profile's key, or \"\"");
}

struct ReadingFile {
  std::vector<Reading> readings;
};
template <class Fields>
void describe(Fields& f, ReadingFile& file) {
  f.tables("readings", file.readings, "the ledger");
}

nlohmann::json read_readings(const std::filesystem::path& path) {
  auto file = read_profile<ReadingFile>(path);
  std::set<std::string> ids;
  for (const Reading& r : file.readings) {
    if (!ids.insert(r.id).second)
      throw InputError("{}: the reading '{}' is given twice; expected unique ids", path.string(), r.id);
    for (const std::string& text : {r.id, r.title, r.paper, r.reading, r.alternatives, r.effect})
      if (text.empty())
        throw InputError("{}: the reading '{}' has an empty text; only 'option' may be empty", path.string(),
                         r.id);
  }
  return settings_to_json(std::move(file))["readings"];
}

}  // namespace hbr::inline reports
