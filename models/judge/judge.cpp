#include "models/judge/judge.h"

#include <algorithm>
#include <cmath>

#include "models/judge/hog.h"
#include "models/judge/nearest.h"
#include "pipeline/artifact/json_file.h"
#include "pipeline/core/check.h"

namespace hbr::inline judge {
namespace {

// n images, the i-th of them data's index_of(i)-th.
template <class IndexOf>
LabelledImages subset(const LabelledImages& data, std::size_t n, IndexOf&& index_of) {
  LabelledImages result;
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint8_t* image = data.image(index_of(i));
    result.images.insert(result.images.end(), image, image + kImagePixels);
    result.labels.push_back(data.labels[index_of(i)]);
  }
  return result;
}

// The least value that at least this share of the values does not exceed.
double quantile(Eigen::VectorXf values, double share) {
  const auto rank = static_cast<Eigen::Index>(std::ceil(share * static_cast<double>(values.size()))) - 1;
  const Eigen::Index at = std::clamp<Eigen::Index>(rank, 0, values.size() - 1);
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[at];
}

}  // namespace

Judge::Judge(const JudgeSettings& settings, const Dataset& dataset, Workers& workers) : settings_(settings) {
  if (settings.bumps > settings.training_images || settings.neighbours > settings.training_images)
    throw InputError("judge: bumps is {} and neighbours {}; expected at most training_images, {}",
                     settings.bumps, settings.neighbours, settings.training_images);
  read_training_images(dataset.train, workers);
  classifier_ =
      fit_rbf_classifier(features_, labels_, kClasses, settings.bumps, settings.gamma, settings.ridge);
  const LabelledImages even =
      subset(dataset.test, (dataset.test.size() + 1) / 2, [](std::size_t i) { return 2 * i; });
  typical_distance_ =
      quantile(judge(even.size(), even.images.data(), workers).distance, settings.typical_share);
}

Judge::Judge(const Hdf5Reader& file, const Dataset& dataset, Workers& workers) {
  const auto matrix = [&](const char* name, Eigen::Index columns) {
    const Array<float> array = file.read<float>(name);
    if (array.shape.size() != 2 || array.shape[0] == 0 ||
        static_cast<Eigen::Index>(array.shape[1]) != columns)
      throw InputError("{}: {} is not a table of {} columns; make it again", file.path().string(), name,
                       columns);
    return Rows(Eigen::Map<const Rows>(array.values.data(), array.shape[0], columns));
  };
  classifier_.centres = matrix("centres", kHogSize);
  classifier_.weights = matrix("weights", kClasses);
  if (classifier_.centres.rows() != classifier_.weights.rows())
    throw InputError("{}: {} centres but {} rows of weights; make it again", file.path().string(),
                     classifier_.centres.rows(), classifier_.weights.rows());
  classifier_.gamma = file.number_attribute("gamma");
  typical_distance_ = file.number_attribute("typical_distance");
  const std::string where = file.path().string() + ": judge";
  settings_ = settings_from_json<JudgeSettings>(parse_json(file.text_attribute("judge"), where), where);
  read_training_images(dataset.train, workers);
}

void Judge::save(Hdf5Writer& file) const {
  const auto matrix = [&](const char* name, const Rows& rows) {
    file.write(name, {static_cast<std::size_t>(rows.rows()), static_cast<std::size_t>(rows.cols())},
               rows.data());
  };
  matrix("centres", classifier_.centres);
  matrix("weights", classifier_.weights);
  file.attribute("gamma", classifier_.gamma);
  file.attribute("typical_distance", typical_distance_);
  file.attribute("judge", settings_to_json(settings_).dump());
}

Verdicts Judge::judge(std::size_t n, const std::uint8_t* images, Workers& workers) const {
  const Rows features = hog_features(n, images, workers);
  const Rows margins = classifier_.margins(features, workers);
  const int k = settings_.neighbours;
  const std::vector<std::int32_t> nearest = nearest_rows(features_, features, k, workers);

  Verdicts verdicts;
  verdicts.label.resize(n);
  verdicts.confidence.resize(n);
  verdicts.distance.resize(n);
  verdicts.typical.resize(n);
  verdicts.good.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    Eigen::Index label = 0;
    verdicts.confidence[i] = margins.row(i).maxCoeff(&label);
    verdicts.label[i] = static_cast<std::uint8_t>(label);
    verdicts.distance[i] = (features.row(i) - features_.row(nearest[i * k])).norm();
    const auto agree = std::count_if(&nearest[i * k], &nearest[i * k] + k,
                                     [&](std::int32_t neighbour) { return labels_[neighbour] == label; });
    verdicts.typical[i] = verdicts.distance[i] <= typical_distance_;
    verdicts.good[i] = verdicts.confidence[i] > 0 && verdicts.typical[i] && 2 * agree > k;
  }
  return verdicts;
}

void Judge::read_training_images(const LabelledImages& train, Workers& workers) {
  const auto wanted = static_cast<std::size_t>(settings_.training_images);
  if (train.size() < wanted)
    throw InputError(
        "[judge] training_images is {}; expected at most {}, the dataset's: set it in the profile", wanted,
        train.size());
  LabelledImages images = subset(train, wanted, [&](std::size_t i) { return i * train.size() / wanted; });
  features_ = hog_features(images.size(), images.images.data(), workers);
  labels_ = std::move(images.labels);
}

std::vector<std::uint8_t> lost_digits(const Verdicts& before, const Verdicts& after) {
  std::vector<std::uint8_t> lost(before.good.size());
  for (std::size_t i = 0; i < lost.size(); ++i)
    lost[i] = before.good[i] && !(after.good[i] && after.label[i] == before.label[i]);
  return lost;
}

}  // namespace hbr::inline judge
