// What kept runs found and cost, in the READMEs: sentences (kept_sentences.h), and tables between two marks,
//
//   <!-- table NAME: `make figures` fills it -->
//   ...
//   <!-- end of table -->
//
// placed by machine, so that a figure there is a kept run's. reports/kept_tables.toml has rows and sentences.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reports/kept/kept_run.h"
#include "reports/kept/kept_sentences.h"
#include "reports/kept/verdict_table.h"

namespace hbr::inline reports {

struct KeptTableRow {
  std::string what;                // the first cell
  std::vector<std::string> runs;   // whose figures it has; none: those of the table
  std::vector<std::string> cells;  // for each run; places as in reports/kept/kept_figures.h
  std::string last;                // the last cell
};

struct KeptTable {
  std::string name, file;  // a path below the repository
  std::vector<std::string> head, runs;
  std::vector<KeptTableRow> rows;
};

struct KeptTables {
  std::string rules;  // reports/claims.toml, a path below the repository
  std::vector<KeptTable> tables;
  std::vector<VerdictTable> verdicts;
  std::vector<KeptSentence> sentences;
};

// Throws InputError: file, line, what was expected and found.
KeptTables read_kept_tables(const std::filesystem::path& path);

// As Markdown. A cell that asks for what its run did not measure, or for a run that is not kept, is a dash.
// Throws InputError where a cell asks for what no run can have, or a row has another number of cells than the
// head.
std::string as_markdown(const KeptTable& table, const std::map<std::string, KeptRun>& kept);

// `text`, of that file, with the table of that name in the place of what stood between its marks. Throws
// InputError where they are missing.
std::string with_table(const std::string& text, const std::string& file, const std::string& name,
                       const std::string& markdown);

// Each file that has tables or sentences, a path below `repository`, with the kept runs' figures. Throws
// InputError as those above and with_sentences do.
std::map<std::string, std::string> filled_files(const KeptTables& all,
                                                const std::map<std::string, KeptRun>& kept,
                                                const std::filesystem::path& repository);

}  // namespace hbr::inline reports
