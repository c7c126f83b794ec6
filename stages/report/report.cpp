// The report: statistics.json and the artifacts -> a folder with index.html. Inputs are named by their paths
// below OUT; the settings say where the claims and the readings are written down.
#include "reports/page/report.h"

#include "pipeline/artifact/stage.h"
#include "pipeline/statistics/statistics_file.h"
#include "reports/claims/claims.h"
#include "reports/claims/readings.h"
#include "reports/kept/speed.h"
#include "reports/readings/study_file.h"

namespace hbr::inline stages {

template <class Fields>
void describe(Fields& f, LayerOfProfile& s) {
  f.text("name", s.name, "of the layer");
  f.text("kind", s.kind, "its kind");
  f.text("meaning", s.meaning, "what it makes");
  f.text("below", s.below, "the layer that it is built on, or \"\"");
  f.text("answers", s.answers, "what a command to it names");
  f.text("asks", s.asks, "what it names in its commands");
}

namespace {

struct VariationName {
  std::string name, changes;
};
template <class Fields>
void describe(Fields& f, VariationName& s) {
  f.text("name", s.name, "its statistics are the input NAME/statistics.json");
  f.text("changes", s.changes, "which reading it changes");
}

struct ReportSettings {
  std::string claims, readings, speed, three;
  std::vector<LayerOfProfile> layers;
  std::vector<std::string> robots;
  std::vector<VariationName> variations;
};
template <class Fields>
void describe(Fields& f, ReportSettings& s) {
  f.text("claims", s.claims, "file of the paper's claims");
  f.text("readings", s.readings, "file of the readings");
  f.text("speed", s.speed, "file of the benchmarks' table");
  f.text("three", s.three, "folder of three.js; empty: robots are shown by pictures alone");
  f.tables("layers", s.layers, "of the profile, each after the one below");
  f.texts("robots", s.robots, "of the profile");
  f.tables("variations", s.variations, "other readings, run beside this one");
}

void run(StageRun& stage) {
  const auto settings = stage.settings_as<ReportSettings>();
  const nlohmann::json statistics = read_statistics(stage.input("statistics.json"));
  std::map<std::string, std::filesystem::path> artifacts;
  nlohmann::json study;
  for (const std::string& name : stage.inputs())
    if (name == "readings.json")
      study = read_study(stage.input(name));
    else if (!name.ends_with("statistics.json"))
      artifacts[name] = stage.input(name);
  std::vector<VariationClaims> variations;
  for (const VariationName& v : settings.variations) {
    const nlohmann::json own = read_statistics(stage.input(v.name + "/statistics.json"));
    variations.push_back({v.name, v.changes, evaluate_claims(settings.claims, own)});
  }
  write_report({statistics.at("profile"), settings.layers, settings.robots, Artifacts(artifacts), statistics,
                evaluate_claims(settings.claims, statistics), read_readings(settings.readings),
                std::move(variations), read_speed(settings.speed), settings.three, study},
               stage.output());
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "The report of the experiment", hbr::run);
}
