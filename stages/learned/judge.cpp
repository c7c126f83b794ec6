// The judge: learns what digits look like, and is itself judged on test images and on random strokes.
#include "models/judge/judge.h"

#include <algorithm>
#include <numeric>

#include "pipeline/artifact/stage.h"
#include "pipeline/core/check.h"
#include "pipeline/core/random.h"
#include "pipeline/drawing/draw.h"
#include "stages/learned/data_settings.h"

namespace {

double share(const std::vector<bool>& answers) {
  return static_cast<double>(std::count(answers.begin(), answers.end(), true)) /
         static_cast<double>(answers.size());
}

std::vector<std::uint8_t> random_strokes(const hbr::StrokesTable& s, hbr::Seed seed) {
  if (s.fewest_points > s.most_points || s.thinnest_px > s.thickest_px)
    throw hbr::InputError("random_strokes: {} to {} points, {} to {} px; expected the lower bound first",
                          s.fewest_points, s.most_points, s.thinnest_px, s.thickest_px);
  std::vector<std::uint8_t> images(static_cast<std::size_t>(s.images) * hbr::kImagePixels);
  std::vector<float> image(hbr::kImagePixels);
  for (int i = 0; i < s.images; ++i) {
    hbr::Rng rng(seed.child(i));
    const int points = s.fewest_points + static_cast<int>(rng.below(s.most_points - s.fewest_points + 1));
    const double width = s.thinnest_px + (s.thickest_px - s.thinnest_px) * rng.uniform_double();
    std::vector<float> pen(2 * points);
    for (float& coordinate : pen) coordinate = rng.uniform();
    hbr::draw(pen.data(), points, width, hbr::Framing::box, 1, image.data());
    hbr::image_to_bytes(image.data(), &images[static_cast<std::size_t>(i) * hbr::kImagePixels]);
  }
  return images;
}

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<hbr::JudgeStage>();
  const hbr::Dataset dataset = hbr::read_dataset(stage.input("dataset"));
  if (dataset.test.size() < 2)
    throw hbr::InputError(
        "{}: {} test images; expected two at least: every other one decides what is typical",
        stage.input("dataset").string(), dataset.test.size());
  hbr::Workers workers(stage.threads());
  const hbr::Judge judge(s.judge, dataset, workers);

  const hbr::Verdicts test = judge.judge(dataset.test.size(), dataset.test.images.data(), workers);
  std::vector<bool> right, typical;
  for (std::size_t i = 0; i < dataset.test.size(); ++i) {
    right.push_back(test.label[i] == dataset.test.labels[i]);
    if (i % 2 == 1) typical.push_back(test.typical[i]);  // the others decided what is typical
  }
  const std::vector<std::uint8_t> strokes =
      random_strokes(s.random_strokes, hbr::Seed(s.seed).child("judge"));
  const hbr::Verdicts random = judge.judge(s.random_strokes.images, strokes.data(), workers);

  hbr::Hdf5Writer file(stage.output());
  judge.save(file);
  file.attribute("test_accuracy", share(right));
  file.attribute("test_typical", share(typical));
  file.attribute("random_typical", share({random.typical.begin(), random.typical.end()}));
  file.attribute("random_good", share({random.good.begin(), random.good.end()}));
  file.close();
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "The judge of the digits", run); }
