// Who may include whom, no circles, and no long files: what keeps the search free of robots and the report
// free of simulations.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace hbr {
namespace {

namespace fs = std::filesystem;

// What a folder may include besides itself: folders, or all folders of a part of the tree.
const std::map<std::string, std::vector<std::string>> kMayInclude = {
    {"pipeline/core", {}},
    {"pipeline/qd", {"pipeline/core"}},
    {"pipeline/drawing", {"pipeline/core"}},
    {"pipeline/hierarchy", {"pipeline/core", "pipeline/qd", "pipeline/drawing"}},
    {"pipeline/hierarchy/layers", {"pipeline/core", "pipeline/qd", "pipeline/drawing", "pipeline/hierarchy"}},
    {"pipeline/process", {"pipeline/core"}},
    {"pipeline/artifact", {"pipeline/core", "pipeline/qd", "pipeline/process"}},
    {"pipeline/statistics", {"pipeline/core", "pipeline/artifact"}},
    {"models", {"pipeline", "models"}},
    {"models/robot/description", {"pipeline/core"}},
    {"models/robot/body", {"pipeline/core", "models/robot/description"}},
    {"models/robot/plane", {"pipeline", "models/robot/description", "models/robot/body"}},
    {"models/robot/looks", {"pipeline/core", "pipeline/process", "models/robot"}},
    {"reports/text", {"pipeline/core", "pipeline/statistics"}},
    {"reports/plot",
     {"pipeline/core", "pipeline/process", "pipeline/artifact", "pipeline/statistics", "reports/text"}},
    {"reports/figures",
     {"pipeline/core", "pipeline/artifact", "pipeline/statistics", "reports/text", "reports/plot"}},
    {"reports/claims", {"pipeline/core", "pipeline/artifact", "pipeline/statistics", "reports/text"}},
    {"reports/readings",
     {"pipeline/core", "pipeline/artifact", "pipeline/statistics", "reports/text", "reports/claims"}},
    {"reports/kept",
     {"pipeline/core", "pipeline/artifact", "pipeline/statistics", "reports/text", "reports/claims"}},
    {"reports/page", {"pipeline/core", "pipeline/artifact", "pipeline/statistics", "reports"}},
    {"reports/compare",
     {"pipeline/core", "pipeline/artifact", "pipeline/statistics", "reports/text", "reports/claims",
      "reports/page"}},
    {"stages/learned", {"pipeline", "models"}},
    {"stages/layers", {"pipeline", "models", "stages/learned"}},
    {"stages/studies", {"pipeline", "models", "stages/learned", "stages/layers"}},
    {"stages/robots", {"pipeline", "models", "stages/learned", "stages/layers", "stages/studies"}},
    {"stages/plan", {"pipeline", "models", "stages/learned", "stages/layers", "stages/robots"}},
    {"stages/report", {"pipeline", "reports"}},
    {"stages/tools", {"pipeline", "models", "reports", "stages/plan", "stages/robots"}},
};
// The table of the kinds of layers, which alone in the engine knows them.
const std::string kLayerTable = "pipeline/hierarchy/layers.cpp";

std::string first_part(const fs::path& path) { return path.begin()->string(); }

// Whose folder's files alone may include what begins so.
const std::map<std::string, std::string> kForeign = {
    {"Simbody.h", "models/robot/body"}, {"ceres/", "models/robot/plane"},
    {"assimp/", "models/robot/looks"},  {"meshoptimizer.h", "models/robot/looks"},
    {"hdf5.h", "pipeline/artifact"},    {"toml++/", "pipeline/artifact"},
    {"sys/wait.h", "pipeline/process"}, {"sys/prctl.h", "pipeline/process"},
};

// "pipeline/qd" of "pipeline/qd/search.h", "models/robot/body" of "models/robot/body/servos.h".
std::string folder_of(const fs::path& file) {
  if (file == kLayerTable) return "pipeline/hierarchy/layers";
  const std::string folder = file.parent_path().string();
  return kMayInclude.contains(folder) ? folder : (first_part(file) / *std::next(file.begin())).string();
}

struct Include {
  fs::path file, included;
  int line;
  bool foreign;  // in angle brackets
};

std::vector<Include> all_includes() {
  std::vector<Include> all;
  for (const char* part : {"pipeline", "models", "reports", "stages"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(HBR_SOURCE_DIR) / part)) {
      const std::string ending = entry.path().extension();
      if (ending != ".h" && ending != ".cpp" && ending != ".in") continue;
      std::ifstream file(entry.path());
      int number = 0;
      for (std::string line; std::getline(file, line);) {
        ++number;
        const std::size_t begin = line.find_first_of("\"<");
        if (!line.starts_with("#include") || begin == std::string::npos) continue;
        all.push_back({entry.path().lexically_relative(HBR_SOURCE_DIR),
                       line.substr(begin + 1, line.find_last_of("\">") - begin - 1), number,
                       line[begin] == '<'});
      }
    }
  return all;
}

bool allowed(const std::string& from, const std::string& to) {
  if (to == "pipeline/hierarchy/layers" && from == "pipeline/hierarchy") return false;
  const auto rule = kMayInclude.find(kMayInclude.contains(from) ? from : first_part(from));
  return from == to ||
         (rule != kMayInclude.end() && std::ranges::any_of(rule->second, [&](const std::string& may) {
            return to == may || to.starts_with(may + "/");
          }));
}

TEST(IncludeRule, EveryIncludeIsAllowed) {
  const std::vector<Include> includes = all_includes();
  EXPECT_GT(includes.size(), 300u);
  for (const auto& [file, included, line, foreign] : includes) {
    if (foreign) continue;
    EXPECT_TRUE(fs::exists(HBR_SOURCE_DIR / included))
        << file << ":" << line << " includes " << included << ", which is not named by its path";
    EXPECT_TRUE(allowed(folder_of(file), folder_of(included)))
        << file << ":" << line << ": " << folder_of(file) << " may not include " << included;
  }
}

TEST(IncludeRule, OneFolderSeesALibrary) {
  std::set<std::string> seen;
  for (const auto& [file, included, line, foreign] : all_includes())
    for (const auto& [header, folder] : kForeign)
      if (foreign && included.string().starts_with(header)) {
        seen.insert(header);
        EXPECT_EQ(file.parent_path(), folder) << file << ":" << line << " includes " << included;
      }
  EXPECT_EQ(seen.size(), kForeign.size());
}

TEST(IncludeRule, FoldersFormNoCircle) {
  std::map<std::string, std::set<std::string>> uses;
  for (const auto& [file, included, line, foreign] : all_includes()) {
    if (foreign) continue;
    uses[folder_of(included)];
    if (folder_of(file) != folder_of(included)) uses[folder_of(file)].insert(folder_of(included));
  }
  while (std::erase_if(uses, [&](const auto& folder) {
    return std::ranges::none_of(folder.second, [&](const std::string& used) { return uses.contains(used); });
  }))
    ;
  std::string circle;
  for (const auto& [folder, used] : uses) circle += " " + folder;
  EXPECT_EQ(circle, "");
}

// Of each folder, inline: names are found as hbr::Name, and two of one name in two folders are two things,
// told by the compiler where both are seen and never mixed by the linker. models/robot has functions called
// robot beside it.
std::string namespace_of(const fs::path& file) {
  const std::string part = first_part(file), folder = *std::next(file.begin());
  if (part == "reports" || part == "stages") return part;
  return folder == "robot" ? "robots" : folder;
}

TEST(IncludeRule, EveryFolderHasItsNamespace) {
  int opened = 0;
  for (const char* part : {"pipeline", "models", "reports", "stages"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(HBR_SOURCE_DIR) / part)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream file(entry.path());
      for (std::string line; std::getline(file, line);) {
        if (!line.starts_with("namespace hbr")) continue;
        ++opened;
        const fs::path path = entry.path().lexically_relative(HBR_SOURCE_DIR);
        // The network's kernels and the checks' formatting are not for others.
        if (line == "namespace hbr::net {" || line == "namespace hbr::detail {") continue;
        EXPECT_EQ(line, "namespace hbr::inline " + namespace_of(path) + " {") << path;
      }
    }
  EXPECT_GT(opened, 400);
}

// One concept a file: what grows past this has two.
TEST(IncludeRule, FilesAreShort) {
  constexpr int kLines = 300;
  int files = 0;
  for (const char* part : {"pipeline", "models", "reports", "stages", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(HBR_SOURCE_DIR) / part)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      ++files;
      std::ifstream file(entry.path());
      const auto lines = std::count(std::istreambuf_iterator<char>(file), {}, '\n');
      EXPECT_LE(lines, kLines) << entry.path();
    }
  EXPECT_GT(files, 400);
}

}  // namespace
}  // namespace hbr
