// Readings of what the paper leaves open, taken together: the statistics of every combination ->
// readings.json.
#include "pipeline/artifact/content.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/statistics/statistics_file.h"
#include "reports/readings/study.h"

namespace hbr::inline stages {

template <class Fields>
void describe(Fields& f, StudiedReading& s) {
  f.text("id", s.id, "of the reading");
  f.texts("values", s.values, "the first is that of the plain run");
}

namespace {

struct CombinationOfReadings {
  std::string name;
  std::vector<double> levels;
};
template <class Fields>
void describe(Fields& f, CombinationOfReadings& s) {
  f.text("name", s.name, "its statistics are the input NAME/statistics.json; empty: statistics.json");
  f.numbers("levels", s.levels, Range{0, 99}, "the value of each reading");
}

struct ReadingsSlice {
  std::string claims, figures;
  std::vector<StudiedReading> readings;
  std::vector<CombinationOfReadings> runs;
};
template <class Fields>
void describe(Fields& f, ReadingsSlice& s) {
  f.text("claims", s.claims, "file of the paper's claims");
  f.text("figures", s.figures, "file of the paper's figures");
  f.tables("readings", s.readings, "what was combined");
  f.tables("runs", s.runs, "the combinations");
}

void run(StageRun& stage) {
  const auto slice = stage.settings_as<ReadingsSlice>();
  std::vector<StudiedRun> runs;
  for (const CombinationOfReadings& r : slice.runs)
    runs.push_back(
        {{r.levels.begin(), r.levels.end()},
         r.name,
         read_statistics(stage.input(r.name.empty() ? "statistics.json" : r.name + "/statistics.json"))});
  write_file(stage.output(),
             study_readings(slice.readings, runs, slice.figures, slice.claims).dump(1) + "\n");
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Readings taken together", hbr::run); }
