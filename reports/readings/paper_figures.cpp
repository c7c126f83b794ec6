#include "reports/readings/paper_figures.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "pipeline/artifact/profile.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/names.h"

namespace hbr::inline reports {

template <class Fields>
void describe(Fields& f, PaperFigure& s) {
  const Range positive{1e-12, 1e12};
  f.text("id", s.id, "unique");
  f.text("place", s.place, "where the paper says so");
  f.text("words", s.words, "what it is, for the reader");
  f.choice("kind", s.kind, {"value", "ratio"}, "what is computed");
  f.text("of", s.of, "name of a statistic");
  f.text("to", s.to, "the statistic it is compared with; \"\" for a value");
  f.number("median", s.median, positive, "the paper's");
  f.numbers("quartiles", s.quartiles, positive, "first and third, or none");
}

namespace {

struct FigureFile {
  std::vector<PaperFigure> figures;
};
template <class Fields>
void describe(Fields& f, FigureFile& s) {
  f.tables("figures", s.figures, "the paper's figures");
}

constexpr double kWithoutQuartiles = 1.1;  // times the median, or its share

}  // namespace

double PaperFigure::distance(double x) const {
  const double spread =
      quartiles.empty() ? 2 * std::log(kWithoutQuartiles) : std::log(quartiles[1] / quartiles[0]);
  return std::abs(std::log(x / median)) / (spread / 2);
}

std::vector<PaperFigure> read_paper_figures(const std::filesystem::path& path) {
  const auto file = read_profile<FigureFile>(path);
  std::set<std::string> ids;
  const auto fail = [&](const PaperFigure& figure, const std::string& what) {
    throw InputError("{}: figure '{}': {}", path.string(), figure.id, what);
  };
  if (file.figures.empty()) throw InputError("{}: no figures; expected one at least", path.string());
  for (const PaperFigure& figure : file.figures) {
    if (figure.id.empty() || !ids.insert(figure.id).second)
      fail(figure, "its id is empty or given twice; expected unique ids");
    if ((figure.kind == "value") != figure.to.empty())
      fail(figure, "'to' is '" + figure.to + "'; expected a statistic, or \"\" where kind is value");
    for (const std::string& name : {figure.of, figure.to})
      if (!name.empty() && !meaning_of(name))
        fail(figure,
             "no statistic can be called '" + name + "'; see pipeline/statistics/names.h for what can");
    const bool ordered = figure.quartiles.size() == 2 && figure.quartiles[0] < figure.quartiles[1] &&
                         figure.quartiles[0] <= figure.median && figure.median <= figure.quartiles[1];
    if (!figure.quartiles.empty() && !ordered)
      fail(figure, "its quartiles are not two numbers, one less than the other, about the median");
  }
  return file.figures;
}

std::optional<double> distance_of_all(const std::vector<std::optional<double>>& distances) {
  if (distances.empty()) return {};
  double sum = 0;
  for (const std::optional<double>& distance : distances) {
    if (!distance) return {};
    sum += std::pow(std::min(*distance, kFarthest), 2);
  }
  return std::sqrt(sum / static_cast<double>(distances.size()));
}

}  // namespace hbr::inline reports
