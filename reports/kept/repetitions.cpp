#include "reports/kept/repetitions.h"

#include <optional>

#include "pipeline/artifact/json_file.h"
#include "pipeline/core/check.h"

namespace hbr::inline reports {

// It writes more, which differs between its versions.
struct WrittenRepetition {
  std::string name, type;
  std::optional<double> rate;
};
template <class Fields>
void describe(Fields& f, WrittenRepetition& r) {
  f.text("run_name", r.name, "of the benchmark");
  f.text("run_type", r.type, "\"iteration\", or a mean of some");
  f.optional_number("items_per_second", r.rate, Range{1e-9, 1e15}, "items per CPU second");
}

namespace {

using nlohmann::json;

WrittenRepetition written_repetition(const json& one, const std::string& where) {
  json asked = one;  // what is no table is refused below
  if (one.is_object()) {
    asked = json::object();
    for (const char* key : {"run_name", "run_type", "items_per_second"})
      if (one.contains(key)) asked[key] = one[key];
  }
  return settings_from_json<WrittenRepetition>(asked, where);
}

}  // namespace

std::map<std::string, Repetition> fastest_repetitions(const std::vector<std::filesystem::path>& results) {
  std::map<std::string, Repetition> best;
  for (const auto& path : results) {
    const json result = read_json(path);
    if (!result.is_object() || !result.contains("benchmarks") || !result["benchmarks"].is_array())
      throw InputError(
          "{}: not what Google Benchmark writes: expected a table with the list 'benchmarks'; measure it "
          "again",
          path.string());
    const json& all = result["benchmarks"];
    for (std::size_t i = 0; i < all.size(); ++i) {
      auto [name, type, rate] =
          written_repetition(all[i], fmt::format("{}: benchmarks.{}", path.string(), i));
      if (type != "iteration" || !rate) continue;
      for (const char* tail : {"/iterations:", "/repeats:"}) name = name.substr(0, name.find(tail));
      if (const auto kept = best.find(name); kept != best.end() && kept->second.rate >= *rate) continue;
      Repetition& fastest = best[name] = {*rate, {}};
      for (const auto& [key, value] : all[i].items())
        if (value.is_number()) fastest.numbers[key] = value.get<double>();
    }
  }
  return best;
}

}  // namespace hbr::inline reports
