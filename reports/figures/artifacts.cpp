#include "reports/figures/artifacts.h"

#include "pipeline/core/check.h"

namespace hbr::inline reports {
namespace {

// "layer2_n10/03.h5" -> "layer2_n10"; empty where the artifact has no replications.
std::string stage_of(const std::string& name) {
  const std::size_t slash = name.find('/');
  return slash != std::string::npos && name.ends_with(".h5") ? name.substr(0, slash) : "";
}

}  // namespace

const std::filesystem::path& Artifacts::path(const std::string& name) const {
  const auto found = paths_.find(name);
  if (found == paths_.end()) throw InputError("the report needs {}, which is not among its inputs", name);
  return found->second;
}

std::vector<std::filesystem::path> Artifacts::replications(const std::string& stage) const {
  std::vector<std::filesystem::path> result;
  for (const auto& [name, path] : paths_)
    if (stage_of(name) == stage) result.push_back(path);
  return result;
}

std::vector<std::string> Artifacts::stages(const std::string& prefix, const std::string& suffix) const {
  std::vector<std::string> result;
  for (const auto& [name, path] : paths_) {
    const std::string stage = stage_of(name);
    const bool wanted = !stage.empty() && stage.starts_with(prefix) && stage.ends_with(suffix);
    if (wanted && (result.empty() || result.back() != stage)) result.push_back(stage);
  }
  return result;
}

std::vector<std::string> Artifacts::ending(const std::string& suffix) const {
  std::vector<std::string> result;
  for (const auto& [name, path] : paths_)
    if (name.ends_with(suffix)) result.push_back(name);
  return result;
}

}  // namespace hbr::inline reports
