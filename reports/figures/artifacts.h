// The artifacts a report is made of, by their names below OUT ("layer2_n10/03.h5"). Which of them exist
// depends on the profile; a figure asks and says so where one is missing.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace hbr::inline reports {

class Artifacts {
 public:
  explicit Artifacts(std::map<std::string, std::filesystem::path> paths) : paths_(std::move(paths)) {}

  bool has(const std::string& name) const { return paths_.contains(name); }
  // Throws InputError where there is none of that name.
  const std::filesystem::path& path(const std::string& name) const;
  // The files "stage/RR.h5" in the order of RR; empty where there are none.
  std::vector<std::filesystem::path> replications(const std::string& stage) const;
  // Stages that have replications and whose name starts with `prefix` and ends with `suffix`, sorted.
  std::vector<std::string> stages(const std::string& prefix, const std::string& suffix = "") const;
  // Artifacts of any kind whose name ends with `suffix`, sorted.
  std::vector<std::string> ending(const std::string& suffix) const;

 private:
  std::map<std::string, std::filesystem::path> paths_;
};

}  // namespace hbr::inline reports
