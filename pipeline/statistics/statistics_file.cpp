#include "pipeline/statistics/statistics_file.h"

#include <limits>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "pipeline/artifact/json_file.h"
#include "pipeline/core/check.h"

namespace hbr::inline statistics {
namespace {

constexpr Range kAny{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::max()};
constexpr Range kCount{0, 1e12}, kShare{0, 1};

struct Named {
  std::string unit, meaning;
};
template <class Fields>
void describe_named(Fields& f, Named& n) {
  f.text("unit", n.unit, "of its values");
  f.text("meaning", n.meaning, "in words");
}

struct Summarised : Named {
  std::int64_t n = 0;
  double median = 0, q1 = 0, q3 = 0, min = 0, max = 0;
};
template <class Fields>
void describe_summary(Fields& f, Summarised& s) {
  describe_named(f, s);
  f.number("n", s.n, Range{1, 1e12}, "how many values");
  f.number("median", s.median, kAny, "of the values");
  f.number("q1", s.q1, kAny, "lower quartile");
  f.number("q3", s.q3, kAny, "upper quartile");
  f.number("min", s.min, kAny, "least value");
  f.number("max", s.max, kAny, "greatest value");
}

struct Quantity : Summarised {
  std::vector<double> values;
  std::vector<int> replications;
};
template <class Fields>
void describe(Fields& f, Quantity& q) {
  describe_summary(f, q);
  f.numbers("values", q.values, kAny, "one of each replication");
  f.numbers("replications", q.replications, Range{0, 1e6}, "whose the values are");
}

struct Number : Named {
  double value = 0;
};
template <class Fields>
void describe(Fields& f, Number& n) {
  describe_named(f, n);
  f.number("value", n.value, kAny, "the number");
}

struct BoxPlot : Summarised {
  double low = 0, high = 0;
  std::int64_t below = 0, above = 0;
};
template <class Fields>
void describe(Fields& f, BoxPlot& b) {
  describe_summary(f, b);
  f.number("low", b.low, kAny, "lower whisker");
  f.number("high", b.high, kAny, "upper whisker");
  f.number("below", b.below, kCount, "outliers below");
  f.number("above", b.above, kCount, "outliers above");
}

struct Test {
  std::string a, b;
  std::int64_t n_a = 0, n_b = 0;
  double p = 0, least_p = 0, a12 = 0, difference = 0;
  std::optional<double> p_exact, ratio;
};
template <class Fields>
void describe(Fields& f, Test& t) {
  f.text("a", t.a, "a quantity's name");
  f.text("b", t.b, "a quantity's name");
  f.number("n_a", t.n_a, kCount, "values of a");
  f.number("n_b", t.n_b, kCount, "values of b");
  f.number("p", t.p, kShare, "of the rank-sum test");
  f.number("least_p", t.least_p, kShare, "the least at these sizes");
  f.number("a12", t.a12, kShare, "effect size");
  f.number("difference", t.difference, kAny, "of the medians");
  f.optional_number("p_exact", t.p_exact, kShare, "of the exact test");
  f.optional_number("ratio", t.ratio, kAny, "of the medians");
}

struct StatisticsFile {
  std::string profile;
  std::map<std::string, Quantity> quantities;
  std::map<std::string, Number> numbers;
  std::map<std::string, Test> tests;
  std::map<std::string, BoxPlot> boxes;
};
template <class Fields>
void describe(Fields& f, StatisticsFile& s) {
  f.text("profile", s.profile, "its name");
  f.named_tables("quantities", s.quantities, "one value per replication");
  f.named_tables("numbers", s.numbers, "what is the same in all replications");
  f.named_tables("tests", s.tests, "rank-sum tests between quantities");
  f.named_tables("boxes", s.boxes, "all values of all replications together");
}

struct CurveHead {
  std::string x;
  std::vector<double> at;
  std::int64_t n = 0;
};
template <class Fields>
void describe(Fields& f, CurveHead& c) {
  f.text("x", c.x, "what is along the axis");
  f.numbers("at", c.at, kAny, "where the values are");
  f.number("n", c.n, kCount, "replications");
}

struct Band {
  std::vector<double> median, q1, q3;
};
template <class Fields>
void describe(Fields& f, Band& b) {
  f.numbers("median", b.median, kAny, "of each place");
  f.numbers("q1", b.q1, kAny, "lower quartile of each place");
  f.numbers("q3", b.q3, kAny, "upper quartile of each place");
}

// Every key but x, at and n is a measure's name.
void check_curve(const nlohmann::json& curve, const std::string& where) {
  nlohmann::json head = nlohmann::json::object();
  for (const char* key : {"x", "at", "n"})
    if (curve.is_object() && curve.contains(key)) head[key] = curve[key];
  const std::size_t places = settings_from_json<CurveHead>(head, where).at.size();
  for (const auto& [name, measure] : curve.items()) {
    if (head.contains(name)) continue;
    const auto band = settings_from_json<Band>(measure, where + ": " + name);
    for (const auto* values : {&band.median, &band.q1, &band.q3})
      if (values->size() != places)
        throw InputError("{}: {}: expected {} values, one of each place of 'at', found {}", where, name,
                         places, values->size());
  }
}

}  // namespace

void check_statistics(const nlohmann::json& statistics, const std::string& where) {
  nlohmann::json sections = statistics;
  if (sections.is_object()) sections.erase("curves");
  const auto file = settings_from_json<StatisticsFile>(sections, where);
  for (const auto& [name, q] : file.quantities) {
    const std::set<int> replications(q.replications.begin(), q.replications.end());
    const auto n = static_cast<std::size_t>(q.n);
    if (q.values.size() != n || q.replications.size() != n || replications.size() != n)
      throw InputError(
          "{}: quantities.{}: expected {} values and as many replications, each once, found {} and {}", where,
          name, n, q.values.size(), replications.size());
  }
  if (statistics.contains("curves"))
    for (const auto& [name, curve] : statistics["curves"].items())
      check_curve(curve, fmt::format("{}: curves.{}", where, name));
}

nlohmann::json read_statistics(const std::filesystem::path& file) {
  nlohmann::json statistics = read_json(file);
  check_statistics(statistics, file.string());
  return statistics;
}

}  // namespace hbr::inline statistics
