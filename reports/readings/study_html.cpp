#include "reports/readings/study_html.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "reports/claims/verdicts.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

using nlohmann::json;
using Row = std::vector<std::string>;

// Shares below this are not worth a reader's time, and p-values above that no evidence.
constexpr double kWorthTelling = 0.05, kEvidence = 0.05;
constexpr std::size_t kShown = 8;  // combinations

std::string text(const json& value) { return escape_html(value.get<std::string>()); }

// What a study may be without: null, or not there.
const json& if_any(const json& table, const char* key) {
  static const json none;
  const auto found = table.find(key);
  return found == table.end() ? none : *found;
}

class StudyTables {
 public:
  StudyTables(const json& study, const json& ledger) : study_(study) {
    std::map<std::string, std::string> titles;
    for (const json& reading : ledger) titles[reading.at("id")] = reading.at("title");
    for (const json& reading : study.at("readings")) {
      const std::string id = reading.at("id");
      titles_.push_back(fmt::format("<a href=\"#reading-{}\">{}</a>", escape_html(id),
                                    escape_html(titles.contains(id) ? titles[id] : id)));
    }
  }

  // The nearest combinations, and the plain run wherever it stands.
  std::string nearest() const {
    Row head{"Rank", "Distance", "Claims reproduced / partly / undecided / not"};
    head.insert(head.end(), titles_.begin(), titles_.end());
    for (const json& figure : study_.at("figures"))
      head.push_back(fmt::format("{}<br><small>paper {}</small>", text(figure.at("words")),
                                 format_number(figure.at("median"))));
    std::vector<Row> rows;
    const json& places = study_.at("nearest");
    for (std::size_t rank = 0; rank < places.size(); ++rank) {
      const auto place = places[rank].get<std::size_t>();
      const json& run = study_.at("runs")[place];
      const bool plain = run.at("name").get<std::string>().empty();
      if (rank < kShown || plain) rows.push_back(combination(rank, place, run, plain));
    }
    return html_table("Combinations of readings that come nearest to the paper", head, rows);
  }

  // What each reading does to each figure.
  std::string figures() const {
    if (study_.at("figures").empty()) return "";
    Row head{"Figure"};
    head.insert(head.end(), titles_.begin(), titles_.end());
    head.insert(head.end(), {"Two together", "Unexplained"});
    std::vector<Row> rows;
    for (const json& figure : study_.at("figures")) {
      const json& moved = if_any(figure, "moved");
      Row row{text(figure.at("words")) +
              (moved.is_null()
                   ? ""
                   : fmt::format("<br><small>{} different runs</small>", moved.at("runs").get<int>()))};
      for (std::size_t r = 0; r < titles_.size(); ++r) row.push_back(effect(moved, r));
      row.push_back(moved.is_null() ? "–" : pairs(moved));
      row.push_back(moved.is_null() ? "–" : percent(moved.at("unexplained")));
      rows.push_back(row);
    }
    return "<p>How a figure is multiplied by each value of a reading, and the share of the variance over the "
           "different runs that the reading explains (combinations that differ in what a figure does not "
           "hang on are one run); bold where that is 5 % or more and, where it can be "
           "tested, p &lt; 0.05.</p>\n" +
           html_table("What each reading does to the paper’s figures", head, rows);
  }

  std::string claims() const {
    std::vector<Row> rows;
    for (const json& claim : study_.at("claims")) {
      std::map<std::string, int> count;
      for (const json& verdict : claim.at("verdicts")) ++count[verdict];
      if (count.size() < 2) continue;
      std::string verdicts;
      for (const auto& [verdict, runs] : count)
        verdicts +=
            (verdict.empty() ? "no answer" : verdict_badge(verdict, "a claim")) + fmt::format(" {} ", runs);
      std::string movers;
      for (const json& check : claim.at("checks"))
        movers +=
            fmt::format("<div>{}: {}</div>", text(check.at("words")), movers_of(if_any(check, "moved")));
      rows.push_back(
          {fmt::format("<a href=\"#claim-{}\">{}</a>", text(claim.at("id")), text(claim.at("statement"))),
           verdicts, movers});
    }
    if (rows.empty()) return "<p>No claim’s verdict depends on these readings.</p>\n";
    return html_table("Claims whose verdict depends on these readings",
                      {"Claim", "Verdicts, in how many combinations", "Moved by (share of the variance)"},
                      rows);
  }

 private:
  static std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }
  static bool told(const json& term) {
    const json& p = if_any(term, "p");
    return term.at("share").get<double>() >= kWorthTelling && (p.is_null() || p.get<double>() < kEvidence);
  }

  Row combination(std::size_t rank, std::size_t place, const json& run, bool plain) const {
    const json &distance = if_any(run, "distance"), &claims = run.at("claims");
    Row row{
        fmt::format("{}{}", rank + 1, plain ? " (this run)" : ""),
        distance.is_null() ? "–" : fmt::format("{:.2f}", distance.get<double>()),
        fmt::format("{} / {} / {} / {}", claims.at("reproduced").get<int>(), claims.at("partly").get<int>(),
                    claims.at("undecided").get<int>(), claims.at("not").get<int>())};
    for (std::size_t r = 0; r < titles_.size(); ++r) {
      const auto level = run.at("levels")[r].get<std::size_t>();
      const std::string value = text(study_.at("readings")[r].at("values")[level]);
      row.push_back(level == 0 ? value : "<b>" + value + "</b>");
    }
    for (const json& figure : study_.at("figures")) {
      const json& x = figure.at("x")[place];
      row.push_back(x.is_null() ? "–" : format_number(x));
    }
    return row;
  }

  // By how much the figure is multiplied (or what is added to it) at each value, and the share of it.
  std::string effect(const json& moved, std::size_t reading) const {
    if (moved.is_null()) return "–";
    const json& effects = moved.at("effects")[reading];
    const bool times = moved.at("logarithm");
    std::string cell;
    for (std::size_t level = 1; level < effects.size(); ++level) {
      const double by = effects[level];
      cell += fmt::format("{}: {}<br>", text(study_.at("readings")[reading].at("values")[level]),
                          times ? fmt::format("× {:.3g}", std::exp(by)) : fmt::format("{:+.3g}", by));
    }
    return cell + share(moved.at("terms")[reading]);
  }
  static std::string share(const json& term) {
    if (term.at("degrees") == 0) return "<small>not told apart</small>";
    const std::string text = percent(term.at("share"));
    return told(term) ? "<b>" + text + "</b>" : "<small>" + text + "</small>";
  }

  std::string pairs(const json& moved) const {
    std::vector<std::string> found;
    if (moved.at("terms").size() == titles_.size()) return "too few combinations";
    for (const json& term : moved.at("terms"))
      if (term.at("readings").size() == 2 && told(term))
        found.push_back(fmt::format("{} × {} {}", titles_[term.at("readings")[0]],
                                    titles_[term.at("readings")[1]], percent(term.at("share"))));
    return found.empty() ? "none" : fmt::format("{}", fmt::join(found, "<br>"));
  }
  std::string movers_of(const json& moved) const {
    if (moved.is_null()) return "not measured in every combination";
    std::vector<std::string> found;
    for (const json& term : moved.at("terms"))
      if (told(term)) {
        std::vector<std::string> names;
        for (const json& reading : term.at("readings")) names.push_back(titles_[reading.get<std::size_t>()]);
        found.push_back(fmt::format("{} {}", fmt::join(names, " × "), percent(term.at("share"))));
      }
    return found.empty() ? "none of them" : fmt::format("{}", fmt::join(found, ", "));
  }

  const json& study_;
  std::vector<std::string> titles_;
};

}  // namespace

std::string study_html(const json& study, const json& ledger) {
  if (study.is_null()) return "";
  const StudyTables tables(study, ledger);
  return fmt::format(
      "<section id=\"readings-study\">\n<h2>Readings taken together</h2>\n"
      "<p>Which experiment did the paper run? {} combinations of {} readings were run, each with the random "
      "numbers of this run. A combination’s distance from the paper is the root of the mean square of its "
      "distances from the figures that the readings move, 1 being as far as the paper’s own quartiles (10 % "
      "where it gives none), by a rule that was written down before the study ran; where they move none, the "
      "one that reproduces more of the claims is nearer.</p>\n{}{}{}</section>\n",
      study.at("runs").size(), study.at("readings").size(), tables.nearest(), tables.figures(),
      tables.claims());
}

}  // namespace hbr::inline reports
