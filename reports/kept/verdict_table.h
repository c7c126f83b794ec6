// The table of the counted claims: what kept runs make of each, and which readings would move it.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "reports/kept/kept_run.h"

namespace hbr::inline reports {

struct VerdictTable {
  std::string name, file;            // as in KeptTable
  std::vector<std::string> runs;     // a column each
  std::vector<std::string> studies;  // runs with variations: those that would read otherwise are named
};

// As Markdown: a row for each claim of the rules, `path`, that a result decides, in the file's order. A
// variation moves a claim where it has another verdict, without regard to size, than the study's own run. A
// run that is not kept is a dash.
std::string as_markdown(const VerdictTable& table, const std::map<std::string, KeptRun>& kept,
                        const std::filesystem::path& path);

}  // namespace hbr::inline reports
