// One reader per kind of artifact: each puts the statistics of all artifacts of its kind into the table.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "pipeline/statistics/names.h"
#include "pipeline/statistics/table.h"

namespace hbr::inline statistics {

struct Artifact {
  ArtifactName name;
  std::filesystem::path path;
};
// By head ("layer2"), each list in the order of its artifacts' names.
using ArtifactsByHead = std::map<std::string, std::vector<Artifact>>;

void read_searches(const ArtifactsByHead& artifacts, StatisticsTable& table);
void read_comparison(const std::vector<Artifact>& artifacts, StatisticsTable& table);
void read_autoencoders(const std::vector<Artifact>& artifacts, StatisticsTable& table);
void read_descriptor(const std::vector<Artifact>& artifacts, StatisticsTable& table);
void read_judge(const std::vector<Artifact>& artifacts, StatisticsTable& table);
void read_accuracy(const std::vector<Artifact>& artifacts, StatisticsTable& table);
// `layers` that a profile calls otherwise than the paper's have statistics of their own.
void read_arc_quality(const std::vector<Artifact>& artifacts, const std::set<std::string>& layers,
                      StatisticsTable& table);
void read_substitution(const std::vector<Artifact>& artifacts, StatisticsTable& table);
void read_digits(const std::vector<Artifact>& artifacts, StatisticsTable& table);
void read_turns(const std::vector<Artifact>& artifacts, StatisticsTable& table);
void read_confusion(const std::vector<Artifact>& networks, const std::vector<Artifact>& digits,
                    StatisticsTable& table);
void read_numbers(const std::vector<Artifact>& artifacts, StatisticsTable& table);
void read_transfer(const std::vector<Artifact>& artifacts, StatisticsTable& table);
void read_dynamics(const std::vector<Artifact>& artifacts, StatisticsTable& table);
void read_tuned(const std::vector<Artifact>& artifacts, StatisticsTable& table);
void read_projected(const std::vector<Artifact>& artifacts, StatisticsTable& table);
void read_planes(const std::vector<Artifact>& artifacts, StatisticsTable& table);

}  // namespace hbr::inline statistics
