#include "pipeline/statistics/factorial.h"

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "pipeline/core/check.h"

namespace hbr::inline statistics {
namespace {

// A factor's columns: one for each level but the last, whose row is minus their sum.
Eigen::RowVectorXd coded(int level, int levels) {
  if (level == levels - 1) return Eigen::RowVectorXd::Constant(levels - 1, -1);
  return Eigen::RowVectorXd::Unit(levels - 1, level);
}

Eigen::MatrixXd columns_of(const std::vector<int>& factors, const std::vector<int>& levels,
                           const std::vector<Levels>& runs) {
  Eigen::MatrixXd columns;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    Eigen::RowVectorXd row = Eigen::RowVectorXd::Ones(1);
    for (const int f : factors) {
      const Eigen::RowVectorXd code = coded(runs[r][f], levels[f]);
      Eigen::RowVectorXd product(row.size() * code.size());
      for (Eigen::Index i = 0; i < row.size(); ++i)
        product.segment(i * code.size(), code.size()) = row[i] * code;
      row = product;
    }
    if (r == 0) columns.resize(static_cast<Eigen::Index>(runs.size()), row.size());
    columns.row(static_cast<Eigen::Index>(r)) = row;
  }
  return columns;
}

struct Fit {
  Eigen::VectorXd coefficients;
  double squares;  // of what is left
  int rank;
};
Fit fit(const Eigen::MatrixXd& model, const Eigen::VectorXd& response) {
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(model);
  const Eigen::VectorXd coefficients = qr.solve(response);
  return {coefficients, (response - model * coefficients).squaredNorm(), static_cast<int>(qr.rank())};
}

// A column of ones, then those of the terms but one.
Eigen::MatrixXd model_of(const std::vector<Eigen::MatrixXd>& terms, Eigen::Index runs, std::size_t without) {
  Eigen::MatrixXd model = Eigen::MatrixXd::Ones(runs, 1);
  for (std::size_t t = 0; t < terms.size(); ++t) {
    if (t == without) continue;
    model.conservativeResize(Eigen::NoChange, model.cols() + terms[t].cols());
    model.rightCols(terms[t].cols()) = terms[t];
  }
  return model;
}

Levels levels_of(const Levels& run, const std::vector<int>& factors) {
  Levels part;
  for (const int f : factors) part.push_back(run[f]);
  return part;
}

// The factors without those on which the response does not hang: runs that differ in nothing else of what is
// kept have the same one.
std::vector<int> factors_that_matter(std::size_t count, const std::vector<Levels>& runs,
                                     const std::vector<double>& response) {
  std::vector<int> kept(count);
  std::iota(kept.begin(), kept.end(), 0);
  for (int f = 0; f < static_cast<int>(count); ++f) {
    std::vector<int> others = kept;
    std::erase(others, f);
    std::map<Levels, double> seen;
    bool copies = false, same = true;
    for (std::size_t r = 0; r < runs.size(); ++r) {
      const auto [first, fresh] = seen.emplace(levels_of(runs[r], others), response[r]);
      copies = copies || !fresh;
      same = same && first->second == response[r];
    }
    if (copies && same) kept = others;
  }
  return kept;
}

FactorialAnalysis analyse_different(const std::vector<int>& levels, const std::vector<Levels>& runs,
                                    const std::vector<double>& response) {
  const auto n = static_cast<Eigen::Index>(runs.size());
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(response.data(), n);
  const double total = (y.array() - y.mean()).square().sum();

  FactorialAnalysis analysis;
  analysis.runs = static_cast<int>(n);
  std::vector<Eigen::MatrixXd> columns;
  Eigen::Index parameters = 1;
  const auto add = [&](const std::vector<int>& factors) {
    columns.push_back(columns_of(factors, levels, runs));
    parameters += columns.back().cols();
    analysis.terms.emplace_back().factors = factors;
  };
  const int count = static_cast<int>(levels.size());
  for (int f = 0; f < count; ++f) add({f});
  Eigen::Index pairs = 0;
  for (int f = 0; f < count; ++f)
    for (int g = f + 1; g < count; ++g) pairs += (levels[f] - 1) * (levels[g] - 1);
  if (parameters + pairs <= n)
    for (int f = 0; f < count; ++f)
      for (int g = f + 1; g < count; ++g) add({f, g});

  const Fit whole = fit(model_of(columns, n, columns.size()), y);
  const int left = static_cast<int>(n) - whole.rank;
  for (std::size_t t = 0; t < columns.size(); ++t) {
    const Fit without = fit(model_of(columns, n, t), y);
    Term& term = analysis.terms[t];
    term.degrees = whole.rank - without.rank;
    const double squares = without.squares - whole.squares;
    if (term.degrees == 0 || !(total > 0)) continue;
    term.share = std::max(0.0, squares / total);
    // Where all is explained to the last digits there is nothing to test against.
    if (left > 0 && whole.squares > 1e-20 * total)
      term.p = boost::math::cdf(
          boost::math::complement(boost::math::fisher_f(term.degrees, left),
                                  std::max(0.0, squares) / term.degrees / (whole.squares / left)));
  }
  if (total > 0) analysis.unexplained = whole.squares / total;

  Eigen::Index at = 1;
  for (int f = 0; f < count; ++f) {
    const Eigen::VectorXd own = whole.coefficients.segment(at, levels[f] - 1);
    at += levels[f] - 1;
    std::vector<double> effects;
    const double base = coded(0, levels[f]).dot(own);
    for (int level = 0; level < levels[f]; ++level)
      effects.push_back(coded(level, levels[f]).dot(own) - base);
    analysis.effects.push_back(effects);
  }
  return analysis;
}

}  // namespace

FactorialAnalysis analyse_factorial(const std::vector<int>& levels, const std::vector<Levels>& runs,
                                    const std::vector<double>& response) {
  HBR_CHECK(runs.size() == response.size() && !runs.empty(), "{} runs, {} responses", runs.size(),
            response.size());
  const std::vector<int> kept = factors_that_matter(levels.size(), runs, response);
  if (kept.size() == levels.size()) return analyse_different(levels, runs, response);

  std::vector<Levels> different;
  std::vector<double> theirs;
  std::set<std::pair<Levels, double>> seen;
  for (std::size_t r = 0; r < runs.size(); ++r)
    if (const Levels part = levels_of(runs[r], kept); seen.emplace(part, response[r]).second) {
      different.push_back(part);
      theirs.push_back(response[r]);
    }
  FactorialAnalysis of_kept = analyse_different(levels_of(levels, kept), different, theirs);

  // Told in the order of all factors.
  std::map<std::vector<int>, Term> terms;
  for (Term& term : of_kept.terms) {
    term.factors = levels_of(kept, term.factors);
    terms.emplace(term.factors, term);
  }
  FactorialAnalysis analysis;
  analysis.unexplained = of_kept.unexplained;
  analysis.runs = of_kept.runs;
  const auto add = [&](const std::vector<int>& factors) {
    const auto found = terms.find(factors);
    int degrees = 1;
    for (const int f : factors) degrees *= levels[f] - 1;
    analysis.terms.push_back(found != terms.end() ? found->second : Term{factors, degrees, 0, {}});
  };
  const int count = static_cast<int>(levels.size());
  for (int f = 0; f < count; ++f) {
    add({f});
    const auto place = std::ranges::find(kept, f);
    analysis.effects.push_back(place != kept.end()
                                   ? of_kept.effects[static_cast<std::size_t>(place - kept.begin())]
                                   : std::vector<double>(static_cast<std::size_t>(levels[f]), 0.0));
  }
  if (kept.size() < 2 || terms.size() > kept.size())
    for (int f = 0; f < count; ++f)
      for (int g = f + 1; g < count; ++g) add({f, g});
  return analysis;
}

}  // namespace hbr::inline statistics
