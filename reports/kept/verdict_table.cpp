#include "reports/kept/verdict_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/claims/claims.h"

namespace hbr::inline reports {
namespace {

using nlohmann::json;

// A study's claims, those of its own run first.
struct Study {
  json own;
  std::vector<std::pair<std::string, json>> variations;
};

Study study_of(const KeptRun& run, const std::filesystem::path& rules) {
  Study study;
  for (const auto& [variation, statistics] : run.statistics) {
    json claims = evaluate_claims(rules, statistics);
    if (variation.empty())
      study.own = std::move(claims);
    else
      study.variations.emplace_back(variation, std::move(claims));
  }
  return study;
}

// "`linear` partly", of the claim with that index.
std::vector<std::string> moves(const Study& study, std::size_t claim) {
  std::vector<std::string> found;
  const std::string own = study.own.at(claim).at("indication");
  if (own.empty()) return found;
  for (const auto& [variation, claims] : study.variations) {
    const std::string other = claims.at(claim).at("indication");
    if (!other.empty() && other != own) found.push_back(fmt::format("`{}` {}", variation, other));
  }
  return found;
}

std::string line(const std::vector<std::string>& cells) {
  return fmt::format("| {} |\n", fmt::join(cells, " | "));
}

}  // namespace

std::string as_markdown(const VerdictTable& table, const std::map<std::string, KeptRun>& kept,
                        const std::filesystem::path& path) {
  std::vector<std::string> head{"Claim"};
  std::map<std::string, json> claims;  // of a run
  for (const std::string& run : table.runs) {
    head.push_back(fmt::format("`{}`", run));
    if (kept.contains(run)) claims[run] = evaluate_claims(path, kept.at(run).statistics.at(""));
  }
  std::vector<Study> studies;
  for (const std::string& run : table.studies) {
    head.push_back(fmt::format("moved in `{}` to", run));
    studies.push_back(kept.contains(run) ? study_of(kept.at(run), path) : Study{});
  }
  std::string text = line(head) + line(std::vector<std::string>(head.size(), "---"));
  const json listed = evaluate_claims(path, {{"quantities", json::object()}, {"numbers", json::object()}});
  for (std::size_t c = 0; c < listed.size(); ++c) {
    if (listed[c].at("decided_by") != "result") continue;
    std::vector<std::string> cells{fmt::format("{} ({})", listed[c].at("statement").get<std::string>(),
                                               listed[c].at("place").get<std::string>())};
    for (const std::string& run : table.runs)
      cells.push_back(claims.contains(run) ? claims[run][c].at("verdict") : json("–"));
    for (const Study& study : studies)
      cells.push_back(study.own.is_null() ? "–" : fmt::format("{}", fmt::join(moves(study, c), ", ")));
    text += line(cells);
  }
  return text;
}

}  // namespace hbr::inline reports
