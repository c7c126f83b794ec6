#include "reports/readings/study.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <tuple>

#include "pipeline/core/check.h"
#include "pipeline/statistics/factorial.h"
#include "reports/claims/claims.h"
#include "reports/claims/measured.h"
#include "reports/readings/paper_figures.h"

namespace hbr::inline reports {
namespace {

using nlohmann::json;
using Responses = std::vector<std::optional<double>>;  // of each run

json or_null(const std::optional<double>& x) { return x ? json(*x) : json(); }

json numbers(const Responses& xs) {
  json result = json::array();
  for (const auto& x : xs) result.push_back(or_null(x));
  return result;
}

class Study {
 public:
  Study(const std::vector<StudiedReading>& readings, const std::vector<StudiedRun>& runs) : runs_(runs) {
    for (const StudiedReading& reading : readings) levels_.push_back(static_cast<int>(reading.values.size()));
    for (const StudiedRun& run : runs) design_.push_back(run.levels);
  }

  json moved(const Responses& xs) const {
    std::vector<double> response;
    for (const auto& x : xs) {
      if (!x || !std::isfinite(*x)) return {};
      response.push_back(*x);
    }
    const bool logarithm = std::ranges::all_of(response, [](double x) { return x > 0; });
    if (logarithm)
      for (double& x : response) x = std::log(x);
    const FactorialAnalysis analysis = analyse_factorial(levels_, design_, response);
    json terms = json::array();
    for (const Term& term : analysis.terms)
      terms.push_back({{"readings", term.factors},
                       {"share", term.share},
                       {"degrees", term.degrees},
                       {"p", or_null(term.p)}});
    return {{"logarithm", logarithm},
            {"terms", terms},
            {"effects", analysis.effects},
            {"unexplained", analysis.unexplained},
            {"runs", analysis.runs}};
  }

  Responses measured(const PaperFigure& figure) const {
    Responses xs;
    for (const StudiedRun& run : runs_) {
      const StatisticsReader statistics(run.statistics);
      const auto of = statistics.figure(figure.of),
                 to = figure.to.empty() ? of : statistics.figure(figure.to);
      xs.push_back(of && to ? computed(figure.kind, *of, *to) : std::nullopt);
      if (xs.back() && !(*xs.back() > 0)) xs.back().reset();  // no distance
    }
    return xs;
  }

  json claims(const std::filesystem::path& file) const {
    std::vector<json> evaluated;
    for (const StudiedRun& run : runs_) evaluated.push_back(evaluate_claims(file, run.statistics));
    json result = json::array();
    for (std::size_t c = 0; c < evaluated[0].size(); ++c) {
      const json& claim = evaluated[0][c];
      json verdicts = json::array(), checks = json::array();
      bool answered = false;
      for (const json& run : evaluated) {
        verdicts.push_back(run[c].at("indication"));
        answered = answered || verdicts.back() != "";
      }
      if (!answered || claim.at("decided_by") != "result" || claim.at("checks").empty()) continue;
      for (std::size_t k = 0; k < claim.at("checks").size(); ++k) {
        Responses xs;
        for (const json& run : evaluated) {
          const json& check = run[c].at("checks")[k];
          xs.push_back(check.contains("x") ? std::optional(check.at("x").get<double>()) : std::nullopt);
        }
        checks.push_back(
            {{"words", claim.at("checks")[k].at("words")}, {"x", numbers(xs)}, {"moved", moved(xs)}});
      }
      result.push_back({{"id", claim.at("id")},
                        {"statement", claim.at("statement")},
                        {"place", claim.at("place")},
                        {"verdicts", verdicts},
                        {"checks", checks}});
    }
    return result;
  }

 private:
  std::vector<int> levels_;
  std::vector<Levels> design_;
  const std::vector<StudiedRun>& runs_;
};

// Whether the readings move a figure, or leave some run without it.
bool differ(const Responses& xs) {
  return std::ranges::adjacent_find(xs, std::ranges::not_equal_to()) != xs.end();
}

// How many of the claims a run reproduces, partly, undecidedly or not.
json verdicts_of(const json& claims, std::size_t run) {
  json count{{"reproduced", 0}, {"partly", 0}, {"undecided", 0}, {"not", 0}};
  for (const json& claim : claims)
    if (const std::string verdict = claim.at("verdicts")[run]; count.contains(verdict))
      count[verdict] = count[verdict].get<int>() + 1;
  return count;
}

// Places of the runs, as study.h says.
std::vector<std::size_t> nearest_first(const json& runs) {
  const auto rank = [&](std::size_t i) {
    const json &run = runs[i], &distance = run.at("distance"), &claims = run.at("claims");
    return std::tuple(distance.is_null() ? std::numeric_limits<double>::infinity() : distance.get<double>(),
                      -claims.at("reproduced").get<int>(), claims.at("not").get<int>());
  };
  std::vector<std::size_t> places(runs.size());
  std::iota(places.begin(), places.end(), 0);
  std::ranges::stable_sort(places, {}, rank);
  return places;
}

}  // namespace

json study_readings(const std::vector<StudiedReading>& readings, const std::vector<StudiedRun>& runs,
                    const std::filesystem::path& figures_file, const std::filesystem::path& claims) {
  const Study study(readings, runs);
  json named = json::array(), figures = json::array(), all = json::array();
  const json answered = study.claims(claims);
  for (const StudiedReading& reading : readings)
    named.push_back({{"id", reading.id}, {"values", reading.values}});
  std::vector<Responses> distances(runs.size());
  for (const PaperFigure& figure : read_paper_figures(figures_file)) {
    const Responses xs = study.measured(figure);
    if (!differ(xs)) continue;
    for (std::size_t r = 0; r < runs.size(); ++r)
      distances[r].push_back(xs[r] ? std::optional(figure.distance(*xs[r])) : std::nullopt);
    figures.push_back({{"id", figure.id},
                       {"place", figure.place},
                       {"words", figure.words},
                       {"median", figure.median},
                       {"quartiles", figure.quartiles},
                       {"x", numbers(xs)},
                       {"moved", study.moved(xs)}});
  }
  for (std::size_t r = 0; r < runs.size(); ++r)
    all.push_back({{"name", runs[r].name},
                   {"levels", runs[r].levels},
                   {"distances", numbers(distances[r])},
                   {"distance", or_null(distance_of_all(distances[r]))},
                   {"claims", verdicts_of(answered, r)}});
  return {{"readings", named},
          {"runs", all},
          {"nearest", nearest_first(all)},
          {"figures", figures},
          {"claims", answered}};
}

}  // namespace hbr::inline reports
