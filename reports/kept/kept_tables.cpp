#include "reports/kept/kept_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/profile.h"
#include "pipeline/core/check.h"
#include "reports/kept/kept_figures.h"

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
  f.texts("runs", t.runs, "whose verdicts it has");
  f.texts("studies", t.studies, "whose variations may move them");
}
template <class Fields>
void describe(Fields& f, KeptSentence& s) {
  f.text("file", s.file, "where it stands");
  f.text("text", s.text, "its words, with places for its figures");
}
template <class Fields>
void describe(Fields& f, KeptTables& t) {
  f.text("rules", t.rules, "claims and their rules");
  f.tables("tables", t.tables, "tables of kept runs");
  f.tables("verdicts", t.verdicts, "tables of their verdicts");
  f.tables("sentences", t.sentences, "sentences with their figures");
}

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
        cells.push_back(kept.contains(run) ? with_figures(cell, kept.at(run)) : kNotMeasured);
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

std::map<std::string, std::string> filled_files(const KeptTables& all,
                                                const std::map<std::string, KeptRun>& kept,
                                                const std::filesystem::path& repository) {
  std::map<std::string, std::string> texts;
  const auto text = [&](const std::string& file) -> std::string& {
    std::string& whole = texts[file];
    if (whole.empty()) whole = read_whole(repository / file);
    return whole;
  };
  const auto place = [&](const auto& table, const std::string& markdown) {
    std::string& whole = text(table.file);
    whole = with_table(whole, table.file, table.name, markdown);
  };
  for (const KeptTable& table : all.tables) place(table, as_markdown(table, kept));
  for (const VerdictTable& table : all.verdicts)
    place(table, as_markdown(table, kept, repository / all.rules));
  for (const KeptSentence& sentence : all.sentences) text(sentence.file);
  for (auto& [file, whole] : texts)
    whole = with_sentences(whole, file, all.sentences, kept, repository / all.rules);
  return texts;
}

}  // namespace hbr::inline reports
