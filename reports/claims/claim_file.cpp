#include "reports/claims/claim_file.h"

#include <algorithm>
#include <limits>
#include <set>

#include "pipeline/artifact/profile.h"
#include "pipeline/core/check.h"
#include "pipeline/statistics/names.h"

namespace hbr::inline reports {

template <class Fields>
void describe(Fields& f, Need& need) {
  f.text("of", need.of, "name of a statistic");
  f.number("at_least", need.at_least, Range{1, 1e12},
           "replications of a quantity, or a number's least value");
}

template <class Fields>
void describe(Fields& f, Size& size) {
  f.text("name", size.name, "what claims call it");
  f.tables("needs", size.needs, "what a run must have");
}

template <class Fields>
void describe(Fields& f, Check& check) {
  const Range any{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};
  f.text("words", check.words, "what is compared, for the reader");
  f.choice("kind", check.kind, {"value", "ratio", "difference", "a12"}, "what is computed");
  f.text("of", check.of, "name of a statistic");
  f.text("to", check.to, "the statistic it is compared with; \"\" for a value");
  f.numbers("reproduced", check.reproduced, any, "low, and high where there is one");
  f.numbers("partly", check.partly, any, "low, and high where there is one");
  f.number("p_below", check.p_below, Range{0, 1}, "rank-sum test; 1 for none");
}

template <class Fields>
void describe(Fields& f, Claim& claim) {
  f.text("id", claim.id, "unique");
  f.text("place", claim.place, "where the paper says so");
  f.text("statement", claim.statement, "the claim in our words");
  f.text("quote", claim.quote, "a few of the paper's words, or \"\"");
  f.text("paper", claim.paper, "the paper's figures");
  f.text("size", claim.size, "a size's name, or \"\"");
  f.choice("decided_by", claim.decided_by, {"result", "design", "ours"},
           "what comes out, the settings, or what comes out of a claim that is not the paper's");
  f.tables("checks", claim.checks, "what decides");
}

template <class Fields>
void describe(Fields& f, ClaimFile& file) {
  f.tables("sizes", file.sizes, "what a run must have to decide a claim");
  f.tables("claims", file.claims, "the paper's claims");
}

namespace {

class Checker {
 public:
  explicit Checker(std::string file) : file_(std::move(file)) {}

  void name(const std::string& where, const std::string& statistic) const {
    if (!meaning_of(statistic))
      throw InputError(
          "{}: {}: no statistic can be called '{}'; see pipeline/statistics/names.h for what can", file_,
          where, statistic);
  }
  void range(const std::string& where, const char* key, std::vector<double>& range) const {
    if (range.size() == 1) range.push_back(std::numeric_limits<double>::infinity());
    if (range.size() != 2 || !(range[0] <= range[1]))
      throw InputError("{}: {}: {} is no range; expected [low, high] or [low]", file_, where, key);
  }
  void unique(std::set<std::string>& seen, const char* what, const std::string& name) const {
    if (name.empty() || !seen.insert(name).second)
      throw InputError("{}: {} '{}' is empty or given twice; expected unique names", file_, what, name);
  }
  void check(const std::string& where, Check& check) const {
    name(where, check.of);
    if ((check.kind == "value") != check.to.empty())
      throw InputError("{}: {}: 'to' is '{}'; expected a statistic, or \"\" where kind is value", file_,
                       where, check.to);
    if (!check.to.empty()) name(where, check.to);
    range(where, "reproduced", check.reproduced);
    range(where, "partly", check.partly);
    if (check.partly[0] > check.reproduced[0] || check.partly[1] < check.reproduced[1])
      throw InputError("{}: {}: 'partly' does not contain 'reproduced'", file_, where);
    if (check.kind == "value" && check.p_below < 1)
      throw InputError("{}: {}: p_below is {}; expected 1, a value has nothing to be tested against", file_,
                       where, check.p_below);
  }

 private:
  std::string file_;
};

}  // namespace

ClaimFile read_claim_file(const std::filesystem::path& path) {
  auto file = read_profile<ClaimFile>(path);
  const Checker checker(path.string());
  std::set<std::string> sizes{""}, ids;
  for (const Size& size : file.sizes) {
    checker.unique(sizes, "size", size.name);
    for (const Need& need : size.needs) checker.name("size '" + size.name + "'", need.of);
  }
  for (Claim& claim : file.claims) {
    checker.unique(ids, "claim", claim.id);
    const std::string where = "claim '" + claim.id + "'";
    if (!sizes.contains(claim.size))
      throw InputError("{}: {}: no size '{}'{}", path.string(), where, claim.size,
                       did_you_mean(claim.size, {sizes.begin(), sizes.end()}));
    if (claim.checks.empty() && claim.size.empty())
      throw InputError("{}: {}: neither checks nor a size; expected something that decides", path.string(),
                       where);
    for (Check& check : claim.checks) checker.check(where, check);
  }
  return file;
}

}  // namespace hbr::inline reports
