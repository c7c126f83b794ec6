#include "reports/kept/verify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "pipeline/statistics/rank_sum.h"
#include "pipeline/statistics/summary.h"

namespace hbr::inline reports {
namespace {

using nlohmann::json;

constexpr double kLevel = 0.01, kFences = 1.5, kOfNumber = 0.1, kOfShare = 0.02;

// Functions of the settings alone.
bool is_count(const std::string& unit) {
  constexpr std::array kCounts = {"evaluations", "executions", "generations", "genes", "requests", "epochs"};
  return std::ranges::find(kCounts, unit) != kCounts.end();
}

std::string kind_of(const std::string& name) { return name.substr(0, name.find('.')); }

struct Quantity {
  std::string unit;
  std::map<int, double> values;  // by replication

  std::vector<double> list() const {
    std::vector<double> all;
    for (const auto& [replication, value] : values) all.push_back(value);
    return all;
  }
  double median() const { return summarise(list(), "").median; }
};

Quantity quantity(const json& entry) {
  Quantity q{entry.at("unit"), {}};
  const std::vector<int> replications = entry.at("replications");
  const std::vector<double> values = entry.at("values");
  for (std::size_t i = 0; i < values.size(); ++i) q.values[replications.at(i)] = values[i];
  return q;
}

// One pair of statistics: the run's, or a variation's.
class Comparison {
 public:
  Comparison(const json& reference, const json& run, const std::string& variation, bool exact,
             Verification& result)
      : reference_(reference),
        run_(run),
        lead_(variation.empty() ? "" : variation + ": "),
        exact_(exact),
        result_(result) {}

  void compare() {
    const json &was = reference_.at("quantities"), &is = run_.at("quantities");
    for (const auto& [name, entry] : was.items())
      if (is.contains(name) && !is_count(entry.at("unit"))) ++tested_;
    for (const auto& [name, entry] : was.items())
      if (is.contains(name)) quantities(name, quantity(entry), quantity(is.at(name)));
    const json &numbers_were = reference_.at("numbers"), &numbers_are = run_.at("numbers");
    for (const auto& [name, entry] : numbers_were.items())
      if (numbers_are.contains(name))
        number(name, entry.at("unit"), entry.at("value"), numbers_are.at(name).at("value"));
    only_in_one(was, is, "quantities");
    only_in_one(numbers_were, numbers_are, "numbers");
    for (const auto& [sizes, count] : sizes_)
      note(fmt::format("{} of the quantities have {} replications here and {} in the reference{}", count,
                       sizes.second, sizes.first, exact_ ? "; those that both have are compared" : ""));
  }
  std::size_t compared() const { return compared_; }

 private:
  void differ(const std::string& line) { result_.differences.push_back(lead_ + line); }
  void note(const std::string& line) { result_.notes.push_back(lead_ + line); }

  void quantities(const std::string& name, const Quantity& was, const Quantity& is) {
    ++compared_;
    if (was.values.size() != is.values.size()) ++sizes_[{was.values.size(), is.values.size()}];
    if (exact_ || is_count(was.unit))
      same_values(name, was, is);
    else
      same_distribution(name, was, is);
  }

  void same_values(const std::string& name, const Quantity& was, const Quantity& is) {
    std::vector<int> others;
    int both = 0;
    for (const auto& [replication, value] : was.values)
      if (const auto found = is.values.find(replication); found != is.values.end()) {
        ++both;
        if (found->second != value) others.push_back(replication);
      }
    if (others.empty()) return;
    const int first = others[0];
    differ(fmt::format(
        "{}: {} of {} replications differ; replication {} was {}, is {}; median {}, is {}; p = {:.2g}", name,
        others.size(), both, first, was.values.at(first), is.values.at(first), was.median(), is.median(),
        rank_sum(was.list(), is.list()).p));
  }

  void same_distribution(const std::string& name, const Quantity& was, const Quantity& is) {
    const double level = kLevel / static_cast<double>(tested_);
    if (least_p(was.values.size(), is.values.size()) < level) {
      const double p = rank_sum(was.list(), is.list()).p;
      if (p < level)
        differ(fmt::format("{}: median was {}, is {} (n = {} and {}); p = {:.2g}, expected at least {:.2g}",
                           name, was.median(), is.median(), was.values.size(), is.values.size(), p, level));
      return;
    }
    const Summary s = summarise(was.list(), name.c_str());
    const double reach = kFences * (s.q3 - s.q1), low = s.q1 - reach, high = s.q3 + reach;
    if (const double median = is.median(); median < low || median > high)
      differ(fmt::format("{}: median was {}, is {} (n = {} and {}); expected {} to {}", name, s.median,
                         median, was.values.size(), is.values.size(), low, high));
  }

  void number(const std::string& name, const std::string& unit, double was, double is) {
    ++compared_;
    if (was == is) return;
    if (exact_ || is_count(unit)) return differ(fmt::format("{}: was {}, is {}", name, was, is));
    const double allowed = unit.empty() ? kOfShare : unit == "%" ? 100 * kOfShare : kOfNumber * std::abs(was);
    if (std::abs(is - was) > allowed)
      differ(
          fmt::format("{}: was {}, is {}; expected {} to {}", name, was, is, was - allowed, was + allowed));
  }

  // Names that `of` has and `other` lacks, by their kind.
  static std::map<std::string, std::vector<std::string>> lacking(const json& of, const json& other) {
    std::map<std::string, std::vector<std::string>> kinds;
    for (const auto& [name, entry] : of.items())
      if (!other.contains(name)) kinds[kind_of(name)].push_back(name);
    return kinds;
  }

  void only_in_one(const json& was, const json& is, const char* what) {
    std::set<std::string> kinds;
    for (const auto& [name, entry] : is.items()) kinds.insert(kind_of(name));
    for (const auto& [kind, names] : lacking(was, is)) {
      if (!kinds.contains(kind))
        note(fmt::format("{}: this run has nothing of it; {} {} of the reference are not compared", kind,
                         names.size(), what));
      else
        for (const std::string& name : names)
          differ(fmt::format("{}: in the reference, but not in this run", name));
    }
    for (const auto& [kind, names] : lacking(is, was))
      note(fmt::format("{}: {} {} of this run are not in the reference and not compared ({}{})", kind,
                       names.size(), what, names[0], names.size() > 1 ? ", ..." : ""));
  }

  const json &reference_, &run_;
  std::string lead_;
  bool exact_;
  Verification& result_;
  std::size_t tested_ = 0, compared_ = 0;
  std::map<std::pair<std::size_t, std::size_t>, int> sizes_;  // of reference and run -> quantities
};

std::string folder_of(const std::string& output) {
  const std::size_t slash = output.rfind('/');
  return slash == std::string::npos ? output : output.substr(0, slash);
}

// Artifacts have the reference's bytes; of those that only one has, the statistics tell.
std::size_t compare_artifacts(const KeptRun& reference, const KeptRun& run, Verification& result) {
  struct Folder {
    int both = 0, others = 0, settings = 0;
    std::string first;
  };
  std::map<std::string, Folder> folders;
  std::size_t both = 0;
  for (const auto& [name, was] : reference.artifacts) {
    const auto is = run.artifacts.find(name);
    if (is == run.artifacts.end()) continue;
    ++both;
    Folder& folder = folders[folder_of(name)];
    ++folder.both;
    folder.settings += is->second.settings != was.settings;
    if (is->second.bytes == was.bytes) continue;
    if (folder.others++ == 0) folder.first = name;
  }
  for (const auto& [name, folder] : folders)
    if (folder.others > 0)
      result.differences.push_back(fmt::format(
          "{}: {} of {} artifacts have other bytes (first {}){}", name, folder.others, folder.both,
          folder.first, folder.settings > 0 ? "; they were made with other settings" : ""));
  return both;
}

const json* claim_named(const json& claims, const std::string& id) {
  const auto found = std::ranges::find_if(claims, [&](const json& c) { return c.at("id") == id; });
  return found == claims.end() ? nullptr : &*found;
}

// Of runs of different sizes one may be decided and the other not: then what both point to is compared.
std::size_t compare_claims(const KeptRun& reference, const KeptRun& run, bool exact, Verification& result) {
  std::size_t compared = 0;
  const auto point_to = [](const json& claim, bool decided) -> std::string {
    return claim.at(decided ? "verdict" : "indication");
  };
  for (const json& was : reference.claims) {
    const std::string id = was.at("id");
    const json* is = claim_named(run.claims, id);
    if (!is) {
      result.notes.push_back(fmt::format("claim {}: no claim of this run", id));
      continue;
    }
    const bool decided = was.at("verdict") != "not at this size" && is->at("verdict") != "not at this size";
    const std::string before = point_to(was, decided), now = point_to(*is, decided);
    if (before.empty() || now.empty()) continue;  // not measured by both: said of the quantities
    ++compared;
    if (before == now) continue;
    const std::string line =
        fmt::format("claim {}: was '{}' ({}), is '{}' ({})", id, before, was.at("ours").get<std::string>(),
                    now, is->at("ours").get<std::string>());
    (exact ? result.differences : result.notes).push_back(line);
  }
  for (const json& is : run.claims)
    if (!claim_named(reference.claims, is.at("id")))
      result.notes.push_back(
          fmt::format("claim {}: no claim of the reference", is.at("id").get<std::string>()));
  return compared;
}

// "compiler 'GCC 12' was 'GCC 11'".
std::string other_toolchain(const json& reference, const json& run) {
  if (reference.is_null()) return "the reference was made by more than one toolchain";
  if (run.is_null()) return "this run was made by more than one toolchain";
  std::vector<std::string> parts;
  for (const auto& [key, value] : reference.items()) {
    const auto was = value.get<std::string>(), is = run.value(key, "");
    if (is != was) parts.push_back(fmt::format("{} was '{}', is '{}'", key, was, is));
  }
  return parts.empty() ? "another toolchain" : fmt::format("{}", fmt::join(parts, "; "));
}

}  // namespace

Verification verify(const KeptRun& reference, const KeptRun& run) {
  Verification result;
  const bool exact = !reference.toolchain.is_null() && reference.toolchain == run.toolchain;
  if (!exact)
    result.notes.push_back("another toolchain: " + other_toolchain(reference.toolchain, run.toolchain));
  if (reference.versions != run.versions)
    result.notes.push_back(fmt::format("the reference is of version {}, this run of {}",
                                       fmt::join(reference.versions, ", "), fmt::join(run.versions, ", ")));
  const std::size_t artifacts = exact ? compare_artifacts(reference, run, result) : 0;
  std::size_t compared = 0;
  for (const auto& [variation, was] : reference.statistics) {
    const auto is = run.statistics.find(variation);
    if (is == run.statistics.end()) {
      result.notes.push_back(fmt::format("variation {}: not in this run, not compared", variation));
      continue;
    }
    Comparison comparison(was, is->second, variation, exact, result);
    comparison.compare();
    compared += comparison.compared();
  }
  for (const auto& [variation, is] : run.statistics)
    if (!reference.statistics.contains(variation))
      result.notes.push_back(fmt::format("variation {}: not in the reference, not compared", variation));
  const std::size_t claims = compare_claims(reference, run, exact, result);
  result.summary =
      fmt::format("{}: {}{} quantities and numbers and {} claims compared with the reference {}: {}",
                  run.profile, exact ? fmt::format("{} artifacts, ", artifacts) : "", compared, claims,
                  exact ? "bit for bit" : "within intervals",
                  result.differences.empty() ? std::string("no difference")
                                             : fmt::format("{} differences", result.differences.size()));
  return result;
}

}  // namespace hbr::inline reports
