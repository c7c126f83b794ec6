#include "pipeline/artifact/tally.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/progress.h"
#include "pipeline/artifact/temporary.h"

namespace hbr::inline artifact {
namespace fs = std::filesystem;
namespace {

fs::path tally_path(const fs::path& out) { return out / ".plan/tally"; }

struct Runs {
  int wanted = 0, made = 0;
  double seconds = 0;  // of those made
};

}  // namespace

void start_tally(const fs::path& out, const std::vector<std::string>& stages, double now) {
  std::string text = fmt::format("start {:.3f}\n", now);
  for (const std::string& stage : stages) text += fmt::format("wanted {}\n", stage);
  write_whole(tally_path(out), text);
}

std::string count_made(const fs::path& out, const std::string& stage, double seconds, double now) {
  if (!fs::exists(tally_path(out))) return "";
  // One write each, so that lines of stages that run side by side do not mix.
  std::ofstream(tally_path(out), std::ios::app) << fmt::format("made {} {:.3f}\n", stage, seconds);

  std::ifstream file(tally_path(out));
  std::map<std::string, Runs> stages;
  double start = 0, took = 0;
  std::string word, name;
  while (file >> word) {
    if (word == "start") file >> start;
    if (word == "wanted" && file >> name) ++stages[name].wanted;
    if (word == "made" && file >> name >> took) {
      ++stages[name].made;
      stages[name].seconds += took;
    }
  }
  Runs all;
  for (const auto& [_, runs] : stages) {
    all.wanted += runs.wanted;
    all.made += runs.made;
    all.seconds += runs.seconds;
  }
  if (all.wanted == 0) return "";
  const std::string count = fmt::format("{} of {}", all.made, all.wanted);
  if (10 * all.made < all.wanted || all.made >= all.wanted || all.seconds <= 0) return count;
  double left = 0;
  for (const auto& [_, runs] : stages) {
    const Runs& like = runs.made > 0 ? runs : all;
    left += std::max(0, runs.wanted - runs.made) * like.seconds / like.made;
  }
  return fmt::format("{}, about {} left", count, duration_text((now - start) * left / all.seconds));
}

}  // namespace hbr::inline artifact
