// The numbers that a hierarchy writes: what the judge reads, digit by digit, and of each number that can be
// read the one it is surest of, stroke by stroke.
#include <algorithm>
#include <map>

#include "models/judge/judge.h"
#include "pipeline/core/check.h"
#include "pipeline/core/parallel.h"
#include "pipeline/hierarchy/layers/numbers.h"
#include "stages/layers/images.h"
#include "stages/layers/read_stack.h"

namespace hbr::inline stages {
namespace {

// Per number what its digits are to the judge.
struct Reading {
  int value = 0;         // its digits, the leftmost first
  bool legible = false;  // every digit is good, and none reaches into another
  float confidence = 0;  // of the least sure digit
};

// The executions of all numbers, one for each.
Executions executed(const LayerModel& numbers, const Elites& elites) {
  Executions executions;
  std::vector<std::uint8_t> possible(static_cast<std::size_t>(elites.size()));
  numbers.executor()->execute(elites.solution, nullptr, 0, elites.size(), Seed(0), executions,
                              possible.data());
  return executions;
}

// Of every value that was read, ascending, the number whose least sure digit is surest.
std::vector<std::size_t> surest(const std::vector<Reading>& readings) {
  std::map<int, std::size_t> best;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!readings[i].legible) continue;
    const auto [at, fresh] = best.emplace(readings[i].value, i);
    if (!fresh && readings[i].confidence > readings[at->second].confidence) at->second = i;
  }
  std::vector<std::size_t> rows;
  for (const auto& [value, row] : best) rows.push_back(row);
  return rows;
}

void write_shown(Hdf5Writer& file, const std::vector<Reading>& readings, const Elites& elites,
                 const Executions& executions, int digits) {
  std::vector<std::int32_t> value, points;
  std::vector<std::int64_t> id;
  std::vector<float> width, pen;
  for (const std::size_t row : surest(readings)) {
    value.push_back(readings[row].value);
    id.push_back(elites.id[row]);
    for (int k = 0; k < digits; ++k) {
      const auto stroke = executions.stroke(static_cast<int>(row), k);
      points.push_back(static_cast<std::int32_t>(stroke.size()));
      width.push_back(executions.pen_down(static_cast<int>(row))[k].width);
      for (const std::int32_t elite : stroke) {
        const Eigen::Vector2f p = executions.points().position(elite).cast<float>();
        pen.insert(pen.end(), {p.x(), p.y()});
      }
    }
  }
  const std::vector<std::size_t> shape{value.size(), static_cast<std::size_t>(digits)};
  file.write("shown/value", value);
  file.write("shown/id", id);
  file.write("shown/points", shape, points.data());
  file.write("shown/width", shape, width.data());
  file.write("shown/pen", {pen.size() / 2, 2}, pen.data());
}

void run(StageRun& stage) {
  Workers workers(stage.threads());
  const StackOnBody stack = read_stack(stage, "layer");
  const LayerModel& numbers = stack.top();
  const Elites& elites = stack.elites.back();
  const int digits = numbers.images();
  if (stack.kinds.back() != "numbers")
    throw InputError("{}: the top layer is of {}; expected numbers", stage.name(), stack.kinds.back());
  const Judge judge(Hdf5Reader(stage.input("judge")), read_dataset(stage.input("dataset")), workers);

  const auto n = static_cast<std::size_t>(elites.size());
  const std::vector<std::uint8_t> images = draw_all(numbers, elites, workers);
  const Verdicts verdicts = judge.judge(n * digits, images.data(), workers);
  const Executions executions = executed(numbers, elites);
  std::vector<Reading> readings(n);
  std::vector<std::uint8_t> legible(n);
  std::vector<std::int32_t> value(n);
  std::vector<float> overlap(n);
  for (std::size_t i = 0; i < n; ++i) {
    overlap[i] = overlap_of_strokes(executions, static_cast<int>(i), digits);
    readings[i] = {0, overlap[i] == 0, 1};
    for (std::size_t k = i * digits; k < (i + 1) * digits; ++k) {
      readings[i].value = 10 * readings[i].value + verdicts.label[k];
      readings[i].legible &= verdicts.good[k] != 0;
      readings[i].confidence = std::min(readings[i].confidence, verdicts.confidence[k]);
    }
    legible[i] = readings[i].legible;
    value[i] = readings[i].value;
  }

  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  file.attribute("digits", std::int64_t{digits});
  file.write("id", elites.id);
  file.write("image", {n, static_cast<std::size_t>(digits), kImageSide, kImageSide}, images.data());
  file.write("value", value);
  file.write("legible", legible);
  file.write("overlap", overlap);
  write_shown(file, readings, elites, executions, digits);
  file.close();
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Numbers before the judge", hbr::run); }
