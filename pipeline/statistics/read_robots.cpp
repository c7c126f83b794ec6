// What other robots made of the arm's lines, arcs and digits.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/readers.h"
#include "pipeline/statistics/summary.h"

namespace hbr::inline statistics {
namespace {

// Values of one kind: a median for each replication, and all of them together.
class Pooled {
 public:
  explicit Pooled(StatisticsTable& table) : table_(table) {}

  // All values of an array, multiplied by `scale`, under NAME.
  void add(const Artifact& artifact, const Hdf5Reader& file, const std::string& array,
           const std::string& measure, double scale) {
    add(artifact, measure, file.read<float>(array).values, scale);
  }
  void add(const Artifact& artifact, const std::string& measure, const std::vector<float>& read,
           double scale) {
    const std::string name = artifact.name.prefix() + "." + measure;
    if (read.empty())
      throw InputError("{}: no value for {}; expected at least one", artifact.path.string(), name);
    std::vector<double> values(read.begin(), read.end());
    for (double& value : values) value *= scale;
    table_.add(name, artifact.name.replication, summarise(values, name.c_str()).median);
    std::vector<double>& all = values_[name];
    all.insert(all.end(), values.begin(), values.end());
  }
  const std::map<std::string, std::vector<double>>& values() const { return values_; }
  void write_boxes() const {
    for (const auto& [name, values] : values_) table_.box(name, values);
  }

 private:
  StatisticsTable& table_;
  std::map<std::string, std::vector<double>> values_;
};

// The joints in the name of a statistic, whose words dots separate: a joint's name without dots and blanks,
// with a number behind where another joint has that name.
std::vector<std::string> words_for(const std::vector<std::string>& joints) {
  std::set<std::string> taken(joints.begin(), joints.end());
  std::vector<std::string> words;
  for (const std::string& joint : joints) {
    std::string plain = joint;
    std::ranges::replace_if(
        plain, [](char c) { return c == '.' || c == ' '; }, '_');
    std::string word = plain;
    if (word != joint)
      for (int k = 2; !taken.insert(word).second; ++k) word = fmt::format("{}_{}", plain, k);
    words.push_back(word);
  }
  return words;
}

// Shares of limits [digits x joints]: the greatest of each digit, and each joint's own.
void add_loads(Pooled& pooled, const Artifact& artifact, const Hdf5Reader& file, const std::string& player,
               const std::string& load) {
  const Array<float> shares = file.read<float>(player + "/" + load);
  std::vector<std::string> joints;
  std::istringstream names(file.text_attribute(player + ".joints"));
  for (std::string name; std::getline(names, name);) joints.push_back(name);
  if (shares.shape.size() != 2 || shares.shape[1] != joints.size() || joints.empty())
    throw InputError("{}: {}/{} does not have a column for each of {} joints", file.path().string(), player,
                     load, joints.size());
  const std::vector<std::string> words = words_for(joints);
  std::vector<float> greatest(shares.shape[0], 0);
  for (std::size_t k = 0; k < joints.size(); ++k) {
    std::vector<float> own;
    for (std::size_t i = 0; i < greatest.size(); ++i) {
      own.push_back(shares.values[i * joints.size() + k]);
      greatest[i] = std::max(greatest[i], own.back());
    }
    pooled.add(artifact, player + "_" + load + "_of." + words[k], own, 100);
  }
  pooled.add(artifact, player + "_" + load, greatest, 100);
}

std::vector<std::uint8_t> flags(const Hdf5Reader& file, const std::string& array) {
  return file.read<std::uint8_t>(array).values;
}

// The share of the digits that are marked, in per cent; of those that `among` marks, where it marks any.
void add_share(StatisticsTable& table, const Artifact& artifact, const std::string& measure,
               const std::vector<std::uint8_t>& marked, const std::vector<std::uint8_t>& among) {
  const auto all = static_cast<double>(among.empty() ? static_cast<std::ptrdiff_t>(marked.size())
                                                     : std::ranges::count(among, 1));
  if (all > 0)
    table.add(artifact.name.prefix() + "." + measure, artifact.name.replication,
              100 * static_cast<double>(std::ranges::count(marked, 1)) / all);
}

}  // namespace

void read_transfer(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  Pooled differences(table), errors(table);
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    for (const char* difference : {"absolute", "squared"}) {  // in per cent, as in the paper
      differences.add(artifact, file, difference, difference, 100);
      differences.add(artifact, file, std::string("evolved/") + difference,
                      std::string("evolved_") + difference, 100);
    }
    const std::vector<std::uint8_t> good = flags(file, "good");
    if (std::ranges::count(good, 1) > 0)
      for (const char* group : {"", "evolved/"})
        add_share(table, artifact, *group ? "evolved_lost" : "lost", flags(file, std::string(group) + "lost"),
                  good);
    for (const char* error : {"end", "displacement"})
      errors.add(artifact, file, std::string("lines/") + error, std::string("line_") + error, 1);
    for (const char* error : {"end", "centre", "length"})
      errors.add(artifact, file, std::string("arcs/") + error, std::string("arc_") + error, 1);
  }
  differences.write_boxes();
  errors.write_boxes();
  for (const auto& [name, values] : differences.values()) {
    const Box b = box(values, name.c_str());
    const auto n = static_cast<double>(b.all.n);
    table.number(name + "_median", b.all.median);
    table.number(name + "_low", b.low);
    table.number(name + "_high", b.high);
    table.number(name + "_outliers", 100 * static_cast<double>(b.above) / n);
    table.number(name.substr(0, name.rfind('.')) + ".images", n);
  }
}

void read_dynamics(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  Pooled pooled(table);
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    pooled.add(artifact, file, "duration", "duration", 1);
    const bool whole = file.has("whole/rms");
    for (const std::string player : {"elites", "wanted", "arm", "whole"}) {
      if (player == "whole" && !whole) continue;
      for (const char* difference : {"absolute", "squared"})
        pooled.add(artifact, file, player + "/" + difference, player + "_" + difference, 100);
      if (player == "elites" || player == "wanted") {
        pooled.add(artifact, file, player + "/travel", player + "_travel", 1);
        continue;
      }
      for (const char* loss : {"off_board", "beyond_limit"})
        add_share(table, artifact, player + "_" + loss, flags(file, player + "/" + loss), {});
      add_share(table, artifact, player + "_lost", flags(file, player + "/lost"), flags(file, "readable"));
      for (const char* error : {"rms", "max", "off_plane"})  // in millimetres
        pooled.add(artifact, file, player + "/" + error, player + "_" + error, 1000);
      pooled.add(artifact, file, player + "/faster", player + "_faster", 1);
      for (const char* load : {"torque", "speed"}) add_loads(pooled, artifact, file, player, load);
      if (!file.has(player + "/margin")) continue;  // it stands on no sole
      pooled.add(artifact, file, player + "/margin", player + "_margin", 1000);
      pooled.add(artifact, file, player + "/grip", player + "_grip", 1);
      add_share(table, artifact, player + "_tips", flags(file, player + "/tips"), {});
    }
  }
  pooled.write_boxes();
  for (const auto& [name, values] : pooled.values())
    if (name.ends_with(".duration"))
      table.number(name.substr(0, name.rfind('.')) + ".digits", static_cast<double>(values.size()));
}

void read_tuned(const std::vector<Artifact>& artifacts, StatisticsTable& table) {
  Pooled pooled(table);
  for (const Artifact& artifact : artifacts) {
    const Hdf5Reader file(artifact.path);
    const int replication = artifact.name.replication;
    double mean_before = 0, good_before = 0;
    for (const std::string state : {"before", "top", "all"}) {
      const std::string name = artifact.name.prefix() + "." + state;
      const std::vector<float> fitness = file.read<float>(state + "/objective").values;
      const std::vector<std::uint8_t> good = file.read<std::uint8_t>(state + "/good").values;
      if (fitness.empty() || good.size() != fitness.size())
        throw InputError("{}: {}/good has {} entries, the fitness {}; expected as many, at least one",
                         artifact.path.string(), state, good.size(), fitness.size());
      const auto n = static_cast<double>(good.size());
      const double mean_fitness = mean(std::vector<double>(fitness.begin(), fitness.end())),
                   good_share = static_cast<double>(std::ranges::count(good, 1)) / n;
      table.add(name + ".size", replication, n);
      table.add(name + ".mean", replication, mean_fitness);
      table.add(name + ".good", replication, good_share);
      pooled.add(artifact, file, state + "/absolute", state + ".difference", 100);
      if (state == "before") {
        mean_before = mean_fitness;
        good_before = good_share;
      } else {
        table.add(name + ".gain", replication, mean_fitness - mean_before);
        table.add(name + ".good_gain", replication, good_share - good_before);
      }
      if (state == "top") continue;  // its lines and arcs are those before
      pooled.add(artifact, file, state + "/arc_fitness", state + ".arc_fitness", 1);
      for (const std::string error : {"line", "arc_centre", "arc_length"})
        for (const std::string& measure : {error, error + "_from_arm"})
          pooled.add(artifact, file, state + "/" + measure, state + "." + measure, 1);
    }
  }
  pooled.write_boxes();
}

}  // namespace hbr::inline statistics
