// What the tool tells about an output folder.
#pragma once

#include <string>
#include <vector>

#include "pipeline/artifact/freshness.h"

namespace hbr::inline artifact {

// A row for each stage: how many artifacts are fresh, stale and missing, and why.
std::string status_table(const Graph& graph, const std::vector<Freshness>& freshness);

struct Audit {
  int read = 0;                       // artifacts
  std::vector<std::string> problems;  // one line each
  std::string summary;
};

// Reads every artifact again, whatever signs and time stamps say.
Audit audit(const Workspace& workspace, const Graph& graph);

}  // namespace hbr::inline artifact
