#include "reports/figures/statistics_view.h"

#include <algorithm>

#include "pipeline/core/check.h"
#include "pipeline/statistics/rank_sum.h"

namespace hbr::inline reports {
namespace {

// Reads with `read`, and says where the file is not as expected instead of what the parser stumbled over.
template <class Read>
auto checked(const std::string& name, Read read) {
  try {
    return read();
  } catch (const nlohmann::json::exception& error) {
    throw InputError("statistics.json: the entry '{}' is not as pipeline/statistics/table.h says: {}", name,
                     error.what());
  }
}

}  // namespace

const nlohmann::json* StatisticsView::find(const char* table, const std::string& name) const {
  const auto entries = json_.find(table);
  if (entries == json_.end()) return nullptr;
  const auto entry = entries->find(name);
  return entry == entries->end() ? nullptr : &*entry;
}

std::vector<double> StatisticsView::quantity(const std::string& name) const {
  const auto* entry = find("quantities", name);
  if (!entry) return {};
  return checked(name, [&] { return entry->at("values").get<std::vector<double>>(); });
}

std::vector<std::string> StatisticsView::quantities(const std::string& prefix,
                                                    const std::string& suffix) const {
  std::vector<std::string> names;
  if (const auto entries = json_.find("quantities"); entries != json_.end())
    for (const auto& [name, entry] : entries->items())
      if (name.starts_with(prefix) && name.ends_with(suffix)) names.push_back(name);
  return names;
}

std::optional<double> StatisticsView::number(const std::string& name) const {
  const auto* entry = find("numbers", name);
  if (!entry) return {};
  return checked(name, [&] { return entry->at("value").get<double>(); });
}

std::optional<Box> StatisticsView::box(const std::string& name) const {
  const auto* entry = find("boxes", name);
  if (!entry) return {};
  return checked(name, [&] {
    Box box;
    box.all = {entry->at("n"),      entry->at("min"), entry->at("q1"),
               entry->at("median"), entry->at("q3"),  entry->at("max")};
    box.low = entry->at("low");
    box.high = entry->at("high");
    box.below = entry->at("below");
    box.above = entry->at("above");
    return box;
  });
}

std::optional<Test> StatisticsView::test(const std::string& a, const std::string& b) const {
  const auto* straight = find("tests", a + "_vs_" + b);
  const auto* entry = straight ? straight : find("tests", b + "_vs_" + a);
  if (!entry) return {};
  return checked(a + "_vs_" + b, [&] {
    Test test{.a12 = entry->at("a12"), .n_a = entry->at("n_a"), .n_b = entry->at("n_b")};
    if (std::min(test.n_a, test.n_b) >= kFewestToTest) test.p = entry->at("p").get<double>();
    if (entry->contains("ratio")) test.ratio = entry->at("ratio").get<double>();
    if (!straight) {
      test.a12 = 1 - test.a12;
      if (test.ratio) test.ratio = 1 / *test.ratio;
      std::swap(test.n_a, test.n_b);
    }
    return test;
  });
}

std::optional<Band> StatisticsView::curve(const std::string& name, const std::string& measure) const {
  const auto* entry = find("curves", name);
  if (!entry || !entry->contains(measure)) return {};
  return checked(name, [&]() -> std::optional<Band> {
    Band band;
    band.x = entry->at("at").get<std::vector<double>>();
    band.median = entry->at(measure).at("median").get<std::vector<double>>();
    band.q1 = entry->at(measure).at("q1").get<std::vector<double>>();
    band.q3 = entry->at(measure).at("q3").get<std::vector<double>>();
    const std::size_t n = band.x.size();
    if (n == 0) return {};
    if (band.median.size() != n || band.q1.size() != n || band.q3.size() != n)
      throw InputError("statistics.json: the curve '{}' has lists of different lengths", name);
    return band;
  });
}

}  // namespace hbr::inline reports
