// export_repertoires OUT FORMAT TO [STAGE [REPLICATION]]: the repertoires of a run, or of a stage, a family
// of stages or a variation of it, for pyribs or QDax, as TO/FORMAT/STAGE/RR.csv or TO/FORMAT/STAGE/RR/*.npy.
// No stage: it makes no artifact.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "pipeline/artifact/freshness.h"
#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/program.h"
#include "pipeline/artifact/temporary.h"
#include "pipeline/core/check.h"
#include "pipeline/core/settings.h"
#include "stages/tools/repertoire_formats.h"

namespace {

namespace fs = std::filesystem;
using namespace hbr;

bool is_repertoire(const fs::path& artifact) {
  const Hdf5Reader file(artifact);
  return std::ranges::all_of(std::vector{"solution", "objective", "measures", "id"},
                             [&](const char* array) { return file.has(array); });
}

struct Exported {
  fs::path path;
  std::string fault;  // in what it is not what its manifest says
};

// "layer2_n10" -> "00" -> the artifact. A file without a manifest is somebody else's.
using Repertoires = std::map<std::string, std::map<std::string, Exported>>;
Repertoires repertoires_of(const fs::path& out) {
  if (!fs::is_directory(out))
    throw InputError("{}: no folder of a run; OUT or PROFILE says where it is", out.string());
  Repertoires found;
  for (auto at = fs::recursive_directory_iterator(out); at != fs::end(at); ++at) {
    const fs::path& path = at->path();
    if (path.filename().string().starts_with('.')) {
      at.disable_recursion_pending();
      continue;
    }
    const fs::path below = path.lexically_relative(out);
    if (path.extension() != ".h5" || !below.has_parent_path()) continue;
    Node node;
    node.output = below.string();
    if (!fs::exists(manifest_path(out, node))) continue;
    const std::string fault = look_at({out, {}, {}}, node, Compare::by_fingerprint).why;
    if (fault.empty() && !is_repertoire(path)) continue;
    found[below.parent_path().string()][below.stem().string()] = {path, fault};
  }
  if (found.empty())
    throw InputError("{} holds no repertoire; `make all` of the profile makes them", out.string());
  return found;
}

// Those of a stage, or else of the family or the variation of this name.
Repertoires selected(const Repertoires& all, const std::string& stage, const fs::path& out) {
  if (stage.empty()) return all;
  Repertoires some;
  std::vector<std::string> names;
  for (const auto& [name, replications] : all) {
    names.push_back(name);
    if (all.contains(stage) ? name == stage : name.starts_with(stage + "_") || name.starts_with(stage + "/"))
      some[name] = replications;
  }
  if (some.empty())
    throw InputError("STAGE '{}': no repertoires of it in {}{}; there are {}", stage, out.string(),
                     did_you_mean(stage, names), fmt::join(names, ", "));
  return some;
}

// "2" -> "02"
std::string two_digits(const std::string& replication) {
  if (replication.find_first_not_of("0123456789") != std::string::npos || replication.size() > 4)
    throw InputError("REP '{}': expected the number of a replication", replication);
  return fmt::format("{:02}", std::stoi(replication));
}

// Replaces what stood there as a whole.
void replace(const fs::path& written, const fs::path& place) {
  const Temporary old(temporary_beside(place, "old"));
  if (fs::exists(place)) fs::rename(place, old.path);
  fs::rename(written, place);
}

void write(const Exported& artifact, const std::string& format, const fs::path& place) {
  if (!artifact.fault.empty())
    throw InputError("{}: {}; `make all` of the profile makes it again", artifact.path.string(),
                     artifact.fault);
  const StoredRepertoire repertoire = read_repertoire(artifact.path);
  fs::create_directories(place.parent_path());
  remove_abandoned(place.parent_path());
  const fs::path to = format == "pyribs" ? place.string() + ".csv" : place.string();
  const Temporary written(temporary_beside(to));
  if (format == "pyribs")
    write_file(written.path, pyribs_csv(repertoire));
  else
    write_qdax(repertoire, written.path);
  replace(written.path, to);
}

int run(const std::vector<std::string>& words) {
  if (words.size() < 3 || words.size() > 5)
    throw InputError("expected export_repertoires OUT FORMAT TO [STAGE [REPLICATION]]");
  const fs::path out = words[0], to = words[2];
  const std::string& format = words[1];
  if (format != "pyribs" && format != "qdax")
    throw InputError("FORMAT '{}': expected pyribs (one .csv each) or qdax (four .npy each)", format);
  const std::string stage = words.size() > 3 ? words[3] : "",
                    replication = words.size() > 4 && !words[4].empty() ? two_digits(words[4]) : "";
  int count = 0;
  for (const auto& [name, replications] : selected(repertoires_of(out), stage, out))
    for (const auto& [number, artifact] : replications) {
      if (!replication.empty() && number != replication) continue;
      write(artifact, format, to / format / name / number);
      ++count;
    }
  if (count == 0) throw InputError("REP {}: no repertoire of that replication", replication);
  fmt::print("{}: {} repertoires for {}\n", (to / format).string(), count, format);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return guarded_main("export_repertoires", [&] { return run({argv + 1, argv + argc}); });
}
