#include "reports/kept/kept_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <regex>

#include "pipeline/artifact/profile.h"
#include "pipeline/core/check.h"
#include "reports/claims/verdicts.h"
#include "reports/text/format.h"
#include "reports/text/template.h"

namespace hbr::inline reports {
template <class Fields>
void describe(Fields& f, KeptTableRow& r) {
  f.text("what", r.what, "first cell");
  f.texts("runs", r.runs, "whose figures it has; none: those of the table");
  f.texts("cells", r.cells, "for each run");
  f.text("last", r.last, "last cell");
}
template <class Fields>
void describe(Fields& f, KeptTable& t) {
  f.text("name", t.name, "as in its marks");
  f.text("file", t.file, "where it stands");
  f.texts("head", t.head, "cells of its head");
  f.texts("runs", t.runs, "whose figures it has");
  f.tables("rows", t.rows, "its rows");
}
template <class Fields>
void describe(Fields& f, VerdictTable& t) {
  f.text("name", t.name, "as in its marks");
  f.text("file", t.file, "where it stands");
  f.text("rules", t.rules, "claims and their rules");
  f.texts("runs", t.runs, "whose verdicts it has");
  f.texts("studies", t.studies, "whose variations may move them");
}
template <class Fields>
void describe(Fields& f, KeptTables& t) {
  f.tables("tables", t.tables, "tables of kept runs");
  f.tables("verdicts", t.verdicts, "tables of their verdicts");
}
namespace {

constexpr const char* kDash = "–";

std::string verdicts_in_words(const nlohmann::json& all) {
  const nlohmann::json claims = claims_decided_by("result", all);
  std::map<std::string, int> times;
  for (const nlohmann::json& claim : claims) ++times[claim.at("verdict")];
  return fmt::format("{} / {} / {} / {} of {}", times["reproduced"], times["partly"], times["undecided"],
                     times["not"], claims.size());
}

std::map<std::string, std::string> values_of(const KeptRun& run) {
  std::map<std::string, std::string> values{{"verdicts", verdicts_in_words(run.claims)}};
  if (run.costs.empty()) return values;
  const StageCost whole = whole_cost(run.costs);
  values["cpu"] = format_quantity(std::round(whole.cpu_seconds), "s");
  values["memory"] = format_number(whole.memory / 1e9, 2) + "\u202fGB";
  values["disk"] = format_number(whole.disk / 1e9, 2) + "\u202fGB";
  return values;
}

// Each place that the text asks for: {{KIND:NAME...}}.
std::string filled(const std::string& text, const KeptRun& run) {
  static const std::regex place(R"(\{\{(\w+):([^:}]+)[^}]*\}\})");
  TemplateContent content;
  content.statistics = run.statistics.at("");
  const std::map<std::string, std::string> values = values_of(run);
  std::string needed;
  for (std::sregex_iterator at(text.begin(), text.end(), place), end; at != end; ++at) {
    if ((*at)[1] != "value") {
      needed += fmt::format(" {}:{}", (*at)[1].str(), (*at)[2].str());
    } else if (const auto found = values.find((*at)[2]); found != values.end()) {
      content.values.insert(*found);
    } else if ((*at)[2] == "cpu" || (*at)[2] == "memory" || (*at)[2] == "disk") {
      return kDash;  // kept before costs were
    }
  }
  return fill_template(
      needed.empty() ? text : fmt::format("{{{{if{}}}}}{}{{{{else}}}}{}{{{{end}}}}", needed, text, kDash),
      content);
}

}  // namespace

KeptTables read_kept_tables(const std::filesystem::path& path) { return read_profile<KeptTables>(path); }

std::string as_markdown(const KeptTable& table, const std::map<std::string, KeptRun>& kept) {
  const auto line = [&](const std::vector<std::string>& cells) {
    if (cells.size() != table.head.size())
      throw InputError("table '{}': expected {} cells, as in its head, found {} in the row of '{}'",
                       table.name, table.head.size(), cells.size(), cells.front());
    return fmt::format("| {} |\n", fmt::join(cells, " | "));
  };
  std::string text = line(table.head) + line(std::vector<std::string>(table.head.size(), "---"));
  for (const KeptTableRow& row : table.rows) {
    std::vector<std::string> cells{row.what};
    for (const std::string& run : row.runs.empty() ? table.runs : row.runs)
      for (const std::string& cell : row.cells)
        cells.push_back(kept.contains(run) ? filled(cell, kept.at(run)) : kDash);
    cells.push_back(row.last);
    text += line(cells);
  }
  return text;
}

std::string with_table(const std::string& text, const std::string& file, const std::string& name,
                       const std::string& markdown) {
  const std::string begin = fmt::format("<!-- table {}: `make figures` fills it -->\n", name),
                    end = "<!-- end of table -->\n";
  const std::size_t from = text.find(begin);
  const std::size_t inside = from == std::string::npos ? from : from + begin.size();
  const std::size_t to = text.find(end, inside), next = text.find("<!-- table ", inside);
  if (to == std::string::npos || next < to)
    throw InputError(
        "{}: expected a line '{}' and below it, before that of any other table, one '{}', found none", file,
        begin.substr(0, begin.size() - 1), end.substr(0, end.size() - 1));
  return text.substr(0, inside) + markdown + text.substr(to);
}

}  // namespace hbr::inline reports
