#include "reports/kept/verify.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "reports/kept/compare_statistics.h"

namespace hbr::inline reports {
namespace {

using nlohmann::json;

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
    compared += compare_statistics(was, is->second, variation, exact, result);
  }
  for (const auto& [variation, is] : run.statistics)
    if (!reference.statistics.contains(variation))
      result.notes.push_back(fmt::format("variation {}: not in the reference, not compared", variation));
  const std::size_t claims = compare_claims(reference, run, exact, result);
  if (artifacts + compared + claims == 0)
    result.differences.push_back("nothing could be compared: no artifact, quantity, number or claim");
  result.summary =
      fmt::format("{}: {}{} quantities and numbers and {} claims compared with the reference {}: {}",
                  run.profile, exact ? fmt::format("{} artifacts, ", artifacts) : "", compared, claims,
                  exact ? "bit for bit" : "within intervals",
                  result.differences.empty() ? std::string("no difference")
                                             : fmt::format("{} differences", result.differences.size()));
  return result;
}

}  // namespace hbr::inline reports
