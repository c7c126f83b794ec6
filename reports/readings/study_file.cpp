#include "reports/readings/study_file.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/artifact/json_file.h"
#include "pipeline/core/check.h"

namespace hbr::inline reports {
namespace {

constexpr Range kFinite{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};
constexpr Range kSharesOfVariance{-1e-6, 1 + 1e-6};  // as rounded
constexpr Range kWholeNumbers{0, 1e6}, kDistances{0, std::numeric_limits<double>::max()};

}  // namespace

struct FiledReading {
  std::string id;
  std::vector<std::string> values;
};
template <class Fields>
void describe(Fields& f, FiledReading& r) {
  f.text("id", r.id, "of the reading");
  f.texts("values", r.values, "the first is that of the plain run");
}

struct FiledVerdicts {
  int reproduced = 0, partly = 0, undecided = 0, not_reproduced = 0;
};
template <class Fields>
void describe(Fields& f, FiledVerdicts& v) {
  f.number("reproduced", v.reproduced, kWholeNumbers, "claims");
  f.number("partly", v.partly, kWholeNumbers, "claims");
  f.number("undecided", v.undecided, kWholeNumbers, "claims");
  f.number("not", v.not_reproduced, kWholeNumbers, "claims");
}

struct FiledRun {
  std::string name;
  std::vector<int> levels;
  std::vector<std::optional<double>> distances;
  std::optional<double> distance;
  FiledVerdicts claims;
};
template <class Fields>
void describe(Fields& f, FiledRun& r) {
  f.text("name", r.name, "of the variation");
  f.numbers("levels", r.levels, kWholeNumbers, "the value of each reading");
  f.optional_numbers("distances", r.distances, kDistances, "from each figure");
  f.optional_number("distance", r.distance, kDistances, "from all figures");
  f.table("claims", r.claims, "how many got which verdict");
}

struct FiledTerm {
  std::vector<int> readings;
  double share = 0;
  int degrees = 0;
  std::optional<double> p;
};
template <class Fields>
void describe(Fields& f, FiledTerm& t) {
  f.numbers("readings", t.readings, kWholeNumbers, "places of one or two");
  f.number("share", t.share, kSharesOfVariance, "of the variance");
  f.number("degrees", t.degrees, kWholeNumbers, "of freedom");
  f.optional_number("p", t.p, Range{0, 1}, "of the F-test");
}

struct FiledMoves {
  bool logarithm = false;
  std::vector<FiledTerm> terms;
  std::vector<std::vector<double>> effects;
  double unexplained = 0;
  int runs = 0;
};
template <class Fields>
void describe(Fields& f, FiledMoves& m) {
  f.flag("logarithm", m.logarithm, "whether it is ln x that is analysed");
  f.tables("terms", m.terms, "each reading, then pairs");
  f.lists_of_numbers("effects", m.effects, kFinite, "of each reading's values");
  f.number("unexplained", m.unexplained, kSharesOfVariance, "share of the variance");
  f.number("runs", m.runs, kWholeNumbers, "that differ");
}

struct FiledFigure {
  std::string id, place, words;
  double median = 0;
  std::vector<double> quartiles;
  std::vector<std::optional<double>> x;
  std::optional<FiledMoves> moved;
};
template <class Fields>
void describe(Fields& f, FiledFigure& s) {
  f.text("id", s.id, "of the figure");
  f.text("place", s.place, "in the paper");
  f.text("words", s.words, "what it is");
  f.number("median", s.median, kFinite, "the paper's");
  f.numbers("quartiles", s.quartiles, kFinite, "the paper's, or none");
  f.optional_numbers("x", s.x, kFinite, "of each run");
  f.optional_table("moved", s.moved, "analysis of variance");
}

struct FiledCheck {
  std::string words;
  std::vector<std::optional<double>> x;
  std::optional<FiledMoves> moved;
};
template <class Fields>
void describe(Fields& f, FiledCheck& c) {
  f.text("words", c.words, "what is checked");
  f.optional_numbers("x", c.x, kFinite, "of each run");
  f.optional_table("moved", c.moved, "analysis of variance");
}

struct FiledClaim {
  std::string id, statement, place;
  std::vector<std::string> verdicts;
  std::vector<FiledCheck> checks;
};
template <class Fields>
void describe(Fields& f, FiledClaim& c) {
  f.text("id", c.id, "of the claim");
  f.text("statement", c.statement, "what the paper says");
  f.text("place", c.place, "in the paper");
  f.texts("verdicts", c.verdicts, "of each run");
  f.tables("checks", c.checks, "what decides it");
}

struct StudyFile {
  std::vector<FiledReading> readings;
  std::vector<FiledRun> runs;
  std::vector<int> nearest;
  std::vector<FiledFigure> figures;
  std::vector<FiledClaim> claims;
};
template <class Fields>
void describe(Fields& f, StudyFile& s) {
  f.tables("readings", s.readings, "what was combined");
  f.tables("runs", s.runs, "the combinations");
  f.numbers("nearest", s.nearest, kWholeNumbers, "places of the runs, the nearest first");
  f.tables("figures", s.figures, "of the paper, that differ between the runs");
  f.tables("claims", s.claims, "of the paper, that a run can answer");
}

namespace {

// That lists have one entry for each thing they tell of, and places are some of what is there.
class StudyFileCheck {
 public:
  explicit StudyFileCheck(const StudyFile& study) : study_(study) {}

  void all() const {
    const std::size_t runs = study_.runs.size();
    for (std::size_t r = 0; r < runs; ++r) levels(study_.runs[r].levels, fmt::format("runs.{}.levels", r));
    length("nearest", study_.nearest.size(), runs);
    for (const int place : study_.nearest) within("nearest", place, runs);
    for (std::size_t i = 0; i < study_.figures.size(); ++i) {
      const std::string where = fmt::format("figures.{}", i);
      length(where + ".x", study_.figures[i].x.size(), runs);
      moved(study_.figures[i].moved, where + ".moved");
    }
    for (std::size_t i = 0; i < study_.claims.size(); ++i) {
      const std::string where = fmt::format("claims.{}", i);
      length(where + ".verdicts", study_.claims[i].verdicts.size(), runs);
      for (std::size_t k = 0; k < study_.claims[i].checks.size(); ++k)
        moved(study_.claims[i].checks[k].moved, fmt::format("{}.checks.{}.moved", where, k));
    }
  }

 private:
  static void length(const std::string& where, std::size_t found, std::size_t expected) {
    if (found != expected) throw InputError("{}: expected {} of them, found {}", where, expected, found);
  }
  static void within(const std::string& where, int place, std::size_t n) {
    if (static_cast<std::size_t>(place) >= n)
      throw InputError("{}: expected places below {}, found {}", where, n, place);
  }
  void levels(const std::vector<int>& levels, const std::string& where) const {
    length(where, levels.size(), study_.readings.size());
    for (std::size_t i = 0; i < levels.size(); ++i)
      within(where, levels[i], study_.readings[i].values.size());
  }
  void moved(const std::optional<FiledMoves>& moves, const std::string& where) const {
    if (!moves) return;
    const std::size_t readings = study_.readings.size();
    if (moves->terms.size() < readings)
      throw InputError("{}.terms: expected at least {}, found {}", where, readings, moves->terms.size());
    for (const FiledTerm& term : moves->terms)
      for (const int reading : term.readings) within(where + ".terms", reading, readings);
    length(where + ".effects", moves->effects.size(), readings);
    for (std::size_t r = 0; r < readings; ++r)
      length(fmt::format("{}.effects.{}", where, r), moves->effects[r].size(),
             study_.readings[r].values.size());
  }

  const StudyFile& study_;
};

}  // namespace

nlohmann::json read_study(const std::filesystem::path& file) {
  nlohmann::json study = read_json(file);
  const auto described = settings_from_json<StudyFile>(study, file.string());
  try {
    StudyFileCheck(described).all();
  } catch (const InputError& error) {
    throw InputError("{}: {}", file.string(), error.what());
  }
  return study;
}

}  // namespace hbr::inline reports
