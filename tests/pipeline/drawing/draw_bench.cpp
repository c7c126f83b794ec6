// Images per second of one core, for paths of 6 to 150 points; the search draws two million images a run.
// OpenCV's polylines on a canvas of 8 x 8 sub-pixels is the rate to beat.
#include <benchmark/benchmark.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "pipeline/core/random.h"
#include "pipeline/drawing/draw.h"

namespace {

constexpr int kPaths = 64;

struct Paths {
  explicit Paths(int points) {
    hbr::Rng rng(hbr::Seed(1));
    for (int p = 0; p < kPaths; ++p) {
      widths.push_back(1 + 3 * rng.uniform());
      auto& path = xy.emplace_back();
      float x = 0, y = 0, heading = 6.28f * rng.uniform();
      for (int i = 0; i < points; ++i) {
        path.insert(path.end(), {x, y});
        heading += rng.uniform(-1, 1) * 10 / static_cast<float>(points);
        x += 2 * std::cos(heading) / static_cast<float>(points);
        y += 2 * std::sin(heading) / static_cast<float>(points);
      }
    }
  }
  std::vector<std::vector<float>> xy;
  std::vector<double> widths;
};

void draw(benchmark::State& state, hbr::Framing framing) {
  const Paths paths(static_cast<int>(state.range(0)));
  std::vector<float> image(hbr::kImagePixels);
  for (auto _ : state)
    for (int p = 0; p < kPaths; ++p) {
      hbr::draw(paths.xy[p].data(), state.range(0), paths.widths[p], framing, 0.64, image.data());
      benchmark::DoNotOptimize(image.data());
    }
  state.SetItemsProcessed(state.iterations() * kPaths);
}
BENCHMARK_CAPTURE(draw, box, hbr::Framing::box)->Arg(6)->Arg(16)->Arg(50)->Arg(150);
BENCHMARK_CAPTURE(draw, workspace, hbr::Framing::workspace)->Arg(6)->Arg(16)->Arg(50)->Arg(150);

void opencv(benchmark::State& state) {
  constexpr int kSub = 8;
  cv::setNumThreads(0);
  const Paths paths(static_cast<int>(state.range(0)));
  cv::Mat canvas(28 * kSub, 28 * kSub, CV_8U), image;
  std::vector<cv::Point> polyline;
  for (auto _ : state)
    for (int p = 0; p < kPaths; ++p) {
      polyline.clear();
      for (std::size_t i = 0; i < paths.xy[p].size(); i += 2)
        polyline.emplace_back(static_cast<int>(std::lround((14 + 22 * paths.xy[p][i]) * kSub * 256)),
                              static_cast<int>(std::lround((14 - 22 * paths.xy[p][i + 1]) * kSub * 256)));
      canvas.setTo(0);
      cv::polylines(canvas, polyline, false, cv::Scalar(255),
                    static_cast<int>(std::lround(paths.widths[p] * kSub)), cv::LINE_8, 8);
      cv::resize(canvas, image, {28, 28}, 0, 0, cv::INTER_AREA);
      benchmark::DoNotOptimize(image.data);
    }
  state.SetItemsProcessed(state.iterations() * kPaths);
}
BENCHMARK(opencv)->Arg(6)->Arg(16)->Arg(50)->Arg(150);

}  // namespace
