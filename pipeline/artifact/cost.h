// What a run is likely to need, by what earlier ones of the same stage and settings did.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/artifact/graph.h"

namespace hbr::inline artifact {

struct Cost {
  double seconds = 0;
  double memory_bytes = 0;
};

// Reads manifests as it is asked about their stages, each folder once.
class MeasuredCosts {
 public:
  explicit MeasuredCosts(std::filesystem::path out) : out_(std::move(out)) {}

  // The most that any replication of the node's stage needed with its settings, on so many threads; nothing
  // where none has run.
  std::optional<Cost> of(const Node& node, int threads);

 private:
  struct Run {
    std::string stage;
    nlohmann::json settings;
    double seconds = 0, cpu_seconds = 0, memory_bytes = 0;
  };
  const std::vector<Run>& runs_in(const std::filesystem::path& folder);

  std::filesystem::path out_;
  std::map<std::filesystem::path, std::vector<Run>> known_;
};

// What to ask of a cluster, with a margin: three times the time and two minutes, one and a half times the
// memory and 200 MB. Of what was never measured: six hours, 4000 MB. Twice as much with every failed try.
struct Request {
  long seconds = 0, memory_mb = 0;
};
Request request_for(const std::optional<Cost>& cost, int failed_tries);

}  // namespace hbr::inline artifact
