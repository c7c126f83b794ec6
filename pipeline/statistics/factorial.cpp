#include "pipeline/statistics/factorial.h"

#include <Eigen/QR>
#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cstdint>
#include <limits>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"

namespace hbr::inline statistics {
namespace {

constexpr std::int64_t kMostCombinations = 65536;
// Of the search for a balanced choice: tries from random choices, fewer where each is long.
constexpr std::size_t kMostTries = 300, kWork = 10'000'000;

std::vector<Levels> all_combinations(const std::vector<int>& levels) {
  std::int64_t count = 1;
  for (const int n : levels) {
    HBR_CHECK(n >= 2, "a factor of {} levels", n);
    count *= n;
    if (count > kMostCombinations)
      throw InputError("more than {} combinations; expected fewer factors or levels", kMostCombinations);
  }
  std::vector<Levels> all;
  Levels now(levels.size(), 0);
  for (std::int64_t i = 0; i < count; ++i) {
    all.push_back(now);
    for (std::size_t f = levels.size(); f-- > 0;) {
      if (++now[f] < levels[f]) break;
      now[f] = 0;
    }
  }
  return all;
}

std::int64_t agreement(const std::vector<int>& levels, const Levels& a, const Levels& b) {
  std::int64_t sum = 0;
  for (std::size_t f = 0; f < levels.size(); ++f) sum += a[f] == b[f] ? levels[f] : 0;
  return sum * sum * sum * sum;
}

// Chosen rows of `all`, and for every row how much it agrees with the chosen ones.
class Chooser {
 public:
  // The first row, and others drawn at random.
  Chooser(const std::vector<int>& levels, const std::vector<Levels>& all, std::size_t runs, Seed seed)
      : levels_(levels), all_(all), cost_(all.size(), 0), taken_(all.size(), 0) {
    add(0);
    Rng rng(seed);
    while (chosen_.size() < runs)
      if (const std::size_t row = rng.below(static_cast<std::uint32_t>(all.size())); !taken_[row]) add(row);
  }

  // Exchanges rows, but the first, as long as one becomes better by it.
  void improve() {
    for (bool better = true; better;) {
      better = false;
      for (std::size_t i = 1; i < chosen_.size(); ++i) {
        const std::size_t old = chosen_[i];
        remove(i);
        const std::size_t next = cheapest();
        better = better || cost_[next] < cost_[old];
        add(cost_[next] < cost_[old] ? next : old);
        std::rotate(chosen_.begin() + static_cast<std::ptrdiff_t>(i), chosen_.end() - 1, chosen_.end());
      }
    }
  }
  std::int64_t total() const {
    std::int64_t sum = 0;
    for (const std::size_t row : chosen_) sum += cost_[row];
    return sum;
  }
  std::vector<Levels> rows() {
    std::ranges::sort(chosen_);
    std::vector<Levels> rows;
    for (const std::size_t i : chosen_) rows.push_back(all_[i]);
    return rows;
  }

 private:
  void change(std::size_t row, std::int64_t sign) {
    for (std::size_t i = 0; i < all_.size(); ++i) cost_[i] += sign * agreement(levels_, all_[row], all_[i]);
    taken_[row] = sign > 0;
  }
  void add(std::size_t row) {
    change(row, 1);
    chosen_.push_back(row);
  }
  void remove(std::size_t place) {
    change(chosen_[place], -1);
    chosen_.erase(chosen_.begin() + static_cast<std::ptrdiff_t>(place));
  }
  std::size_t cheapest() const {
    std::size_t best = 0;
    auto least = std::numeric_limits<std::int64_t>::max();
    for (std::size_t i = 0; i < all_.size(); ++i)
      if (!taken_[i] && cost_[i] < least) {
        least = cost_[i];
        best = i;
      }
    return best;
  }

  const std::vector<int>& levels_;
  const std::vector<Levels>& all_;
  std::vector<std::int64_t> cost_;
  std::vector<std::uint8_t> taken_;
  std::vector<std::size_t> chosen_;
};

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

}  // namespace

std::vector<Levels> factorial_design(const std::vector<int>& levels, int runs) {
  std::vector<Levels> all = all_combinations(levels);
  if (runs <= 0 || static_cast<std::size_t>(runs) >= all.size()) return all;
  const auto wanted = static_cast<std::size_t>(runs);
  const std::size_t tries = std::clamp<std::size_t>(kWork / (all.size() * wanted), 1, kMostTries);
  std::optional<Chooser> best;
  for (std::size_t i = 0; i < tries; ++i) {
    Chooser chooser(levels, all, wanted, Seed(0).child("factorial design").child(i));
    chooser.improve();
    if (!best || chooser.total() < best->total()) best.emplace(std::move(chooser));
  }
  return best->rows();
}

FactorialAnalysis analyse_factorial(const std::vector<int>& levels, const std::vector<Levels>& runs,
                                    const std::vector<double>& response) {
  HBR_CHECK(runs.size() == response.size() && !runs.empty(), "{} runs, {} responses", runs.size(),
            response.size());
  const auto n = static_cast<Eigen::Index>(runs.size());
  const Eigen::VectorXd y = Eigen::Map<const Eigen::VectorXd>(response.data(), n);
  const double total = (y.array() - y.mean()).square().sum();

  FactorialAnalysis analysis;
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

}  // namespace hbr::inline statistics
