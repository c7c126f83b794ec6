#include "reports/text/template.h"

#include <algorithm>
#include <set>
#include <sstream>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/statistics/names.h"
#include "pipeline/statistics/rank_sum.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

// Kinds of places that the statistics fill, and the table of statistics.json that does.
const std::map<std::string, std::string> kTables = {
    {"stat", "quantities"}, {"number", "numbers"}, {"test", "tests"}};

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, separator);)
    if (!part.empty()) parts.push_back(part);
  return parts;
}

class Filler {
 public:
  Filler(const std::string& text, const TemplateContent& content) : text_(text), content_(content) {}

  std::string fill() {
    std::string result;
    while (at_ < text_.size()) {
      const std::size_t open = text_.find("{{", at_);
      result.append(text_, at_, open == std::string::npos ? open : open - at_);
      if (open == std::string::npos) break;
      const std::size_t close = text_.find("}}", open);
      if (close == std::string::npos)
        throw InputError("the page template has an unclosed {{{{ in line {}", line(open));
      const std::string tag = text_.substr(open + 2, close - open - 2);
      at_ = close + 2;
      if (tag.starts_with("if ")) {
        branch(tag.substr(3), open);
      } else if (tag == "else") {
        if (!in_branch_)
          throw InputError("the page template has {{{{else}}}} without if in line {}", line(open));
        skip_to_end(open);
      } else if (tag == "end") {
        if (!in_branch_)
          throw InputError("the page template has {{{{end}}}} without if in line {}", line(open));
        in_branch_ = false;
      } else {
        result += place(tag, open);
      }
    }
    if (in_branch_) throw InputError("the page template has an {{{{if}}}} without {{{{end}}}}");
    check_all_used();
    return result;
  }

 private:
  std::ptrdiff_t line(std::size_t position) const {
    return std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(position), '\n') + 1;
  }

  // The entry, or null where it was not measured.
  const nlohmann::json* find(const std::string& kind, const std::string& name) const {
    const auto all = content_.statistics.find(kTables.at(kind));
    if (all == content_.statistics.end()) return nullptr;
    const auto found = all->find(name);
    return found == all->end() ? nullptr : &*found;
  }

  // Whether the statistics of any profile can have it.
  static bool in_vocabulary(const std::string& kind, const std::string& name) {
    const std::size_t versus = name.find("_vs_");
    if (kind != "test") return meaning_of(name).has_value();
    return versus != std::string::npos && meaning_of(name.substr(0, versus)) &&
           meaning_of(name.substr(versus + 4));
  }

  void branch(const std::string& condition, std::size_t open) {
    if (in_branch_) throw InputError("the page template nests an {{{{if}}}} in line {}", line(open));
    bool all = true;
    for (const std::string& name : split(condition, ' ')) {
      const auto parts = split(name, ':');
      if (parts.size() != 2 || !kTables.contains(parts[0]))
        throw InputError(
            "the page template asks in line {} for '{}'; expected stat:NAME, number:NAME or test:A_vs_B",
            line(open), name);
      if (find(parts[0], parts[1])) continue;
      if (!in_vocabulary(parts[0], parts[1]))
        throw InputError(
            "the page template asks in line {} whether '{}' was measured, which no profile measures",
            line(open), name);
      all = false;
    }
    in_branch_ = true;
    if (!all) skip_to_else(open);
  }

  // Goes on behind {{else}} (or {{end}} where there is none).
  void skip_to_else(std::size_t open) {
    const std::size_t other = text_.find("{{else}}", at_), end = text_.find("{{end}}", at_);
    if (end == std::string::npos)
      throw InputError("the page template has an {{{{if}}}} without end in line {}", line(open));
    if (other < end) {
      note_skipped(other);
      at_ = other + 8;
    } else {
      note_skipped(end);
      at_ = end;
    }
  }

  void skip_to_end(std::size_t open) {
    const std::size_t end = text_.find("{{end}}", at_);
    if (end == std::string::npos)
      throw InputError("the page template has an {{{{if}}}} without end in line {}", line(open));
    note_skipped(end);
    at_ = end;
  }

  // What stands in the branch not taken counts as used: the page has a place for it.
  void note_skipped(std::size_t end) {
    const std::string skipped = text_.substr(at_, end - at_);
    for (const auto& [name, html] : content_.values)
      if (skipped.find("{{value:" + name + "}}") != std::string::npos) used_.insert("value:" + name);
    for (const auto& [name, html] : content_.figures)
      if (skipped.find("{{figure:" + name + "}}") != std::string::npos) used_.insert("figure:" + name);
  }

  std::string place(const std::string& tag, std::size_t open) {
    const auto parts = split(tag, ':');
    const auto unknown = [&] {
      return InputError("the page template asks in line {} for '{}', which nothing fills", line(open), tag);
    };
    if (parts.size() == 2 && (parts[0] == "value" || parts[0] == "figure")) {
      const auto& all = parts[0] == "value" ? content_.values : content_.figures;
      const auto found = all.find(parts[1]);
      if (found == all.end()) throw unknown();
      used_.insert(tag);
      return found->second;
    }
    const nlohmann::json* entry =
        parts.size() >= 2 && kTables.contains(parts[0]) ? find(parts[0], parts[1]) : nullptr;
    if (!entry) throw unknown();
    const std::string field = parts.size() > 2 ? parts[2] : parts[0] == "number" ? "value" : "";
    if (parts[0] == "stat" && (field.empty() || field == "percent")) {
      const double scale = field.empty() ? 1 : 100;
      const auto number = [&](const char* key) { return scale * entry->at(key).get<double>(); };
      return format_quartiles(number("median"), number("q1"), number("q3"),
                              field.empty() ? unit(*entry) : "%");
    }
    if (parts[0] == "stat" && field == "share" && parts.size() == 3)
      return format_quantity(100 * entry->at("median").get<double>(), "%");
    if (parts.size() > 3 || !entry->contains(field) || !entry->at(field).is_number()) throw unknown();
    const double number = entry->at(field);
    if (field == "p") {
      const std::size_t n_a = entry->at("n_a"), n_b = entry->at("n_b");
      return std::min(n_a, n_b) < kFewestToTest ? "too few replications for a test"
                                                : "p = " + format_p(number);
    }
    const bool pure = field == "n" || field == "a12" || field == "ratio" || parts[0] == "test";
    return pure ? format_number(number) : format_quantity(number, unit(*entry));
  }

  static std::string unit(const nlohmann::json& entry) { return escape_html(entry.value("unit", "")); }

  void check_all_used() const {
    std::string unused;
    const auto look = [&](const std::string& kind, const std::map<std::string, std::string>& all) {
      for (const auto& [name, html] : all)
        if (!used_.contains(kind + ":" + name)) unused += (unused.empty() ? "" : ", ") + kind + ":" + name;
    };
    look("value", content_.values);
    look("figure", content_.figures);
    if (!unused.empty()) throw InputError("the page template has no place for: {}", unused);
  }

  const std::string& text_;
  const TemplateContent& content_;
  std::set<std::string> used_;
  std::size_t at_ = 0;
  bool in_branch_ = false;
};

}  // namespace

std::string fill_template(const std::string& text, const TemplateContent& content) {
  return Filler(text, content).fill();
}

}  // namespace hbr::inline reports
