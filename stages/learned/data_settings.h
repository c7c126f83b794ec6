// What the stages of the data and of the judge are told.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "models/judge/judge.h"
#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/settings.h"

namespace hbr::inline stages {

struct DatasetSettings {
  std::string name;
  std::string folder;
  std::vector<std::string> sha256;
};
template <class Fields>
void describe(Fields& f, DatasetSettings& s) {
  f.text("name", s.name, "what the dataset is called");
  f.text("folder", s.folder, "where its four IDX files are, plain or gzipped");
  f.texts(
      "sha256", s.sha256,
      "of their unpacked content: train images, train labels, test images, test labels; none: not checked");
}

// Random strokes: a pen that visits points drawn uniformly in a square. A judge that likes them is of no use.
struct StrokesTable {
  int images = 0;
  int fewest_points = 0;
  int most_points = 0;
  double thinnest_px = 0;
  double thickest_px = 0;
};
template <class Fields>
void describe(Fields& f, StrokesTable& s) {
  f.number("images", s.images, Range{1, 1e6}, "how many");
  f.number("fewest_points", s.fewest_points, Range{1, 1000}, "points of a stroke, at least");
  f.number("most_points", s.most_points, Range{1, 1000}, "points of a stroke, at most");
  f.number("thinnest_px", s.thinnest_px, Range{0.5, 14}, "pen width, pixels, at least");
  f.number("thickest_px", s.thickest_px, Range{0.5, 14}, "pen width, pixels, at most");
}

struct JudgeStage {
  std::uint64_t seed = 0;
  JudgeSettings judge;
  StrokesTable random_strokes;
};
template <class Fields>
void describe(Fields& f, JudgeStage& s) {
  describe_seed(f, s.seed);
  f.table("judge", s.judge, "the judge");
  f.table("random_strokes", s.random_strokes, "the control");
}

}  // namespace hbr::inline stages
