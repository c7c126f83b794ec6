#include "stages/plan/profile_name.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "pipeline/core/check.h"
#include "pipeline/core/settings.h"

namespace hbr::inline stages {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> names_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

fs::path profile_file(const std::string& word, const fs::path& folder) {
  if (word.ends_with(".toml")) return word;  // reading it says what is wrong with it
  if (word.find('/') == std::string::npos) {
    if (const fs::path file = folder / (word + ".toml"); fs::is_regular_file(file)) return file;
    const std::vector<std::string> names = names_in(folder);
    throw InputError("no profile '{}'{}; expected one of {}, or a file.toml", word, did_you_mean(word, names),
                     fmt::join(names, ", "));
  }
  if (fs::is_regular_file(word)) return word;
  if (fs::is_regular_file(word + ".toml")) return word + ".toml";
  throw InputError(
      "PROFILE is '{}': {}; expected a file.toml, or a name out of {}", word,
      fs::is_directory(word) ? "this is a folder" : "there is no such file, nor with .toml behind it",
      folder.string());
}

}  // namespace hbr::inline stages
