// The judge: what someone who knows handwritten digits, and whom the search has never met, says of an image.
//
// Three questions, since a classifier alone answers "yes" to many a scribble: does its one-against-rest
// margin accept the image (rbf_classifier.h); is the image as near to one of the training images, in HOG
// space, as 95 % of the dataset's own test images are ("typical"); are most of its nearest training images of
// the same class? "Good" is all three.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "models/dataset/dataset.h"
#include "models/judge/rbf_classifier.h"
#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/parallel.h"
#include "pipeline/core/settings.h"

namespace hbr::inline judge {

struct JudgeSettings {
  int training_images = 0;
  int bumps = 0;
  double gamma = 0;
  double ridge = 0;
  int neighbours = 0;
  double typical_share = 0;
};
template <class Fields>
void describe(Fields& f, JudgeSettings& s) {
  f.number("training_images", s.training_images, Range{10, 1e7},
           "images that the judge learns from and measures distances to, evenly taken from the training set");
  f.number("bumps", s.bumps, Range{10, 2e4}, "centres of the classifier, evenly taken from them");
  f.number("gamma", s.gamma, Range{1e-4, 100}, "a bump is exp(-gamma d^2), d the distance in HOG space");
  f.number("ridge", s.ridge, Range{0.01, 1e6}, "penalty on the classifier's squared weights");
  f.number("neighbours", s.neighbours, Range{1, 1000},
           "k: nearest training images that are asked for their class");
  f.number("typical_share", s.typical_share, Range{0.01, 0.999}, "share of the test images that are typical");
}

// About n images, an entry each.
struct Verdicts {
  std::vector<std::uint8_t> label;    // the class with the largest margin
  Eigen::VectorXf confidence;         // that margin: about 1 for a digit, positive means accepted
  Eigen::VectorXf distance;           // to the nearest training image in HOG space
  std::vector<std::uint8_t> typical;  // 1 where the distance is
  std::vector<std::uint8_t> good;     // 1 where accepted, typical, and most neighbours have the label
};

// Of digits that were good before: 1 where they are not good any more, or of another class.
std::vector<std::uint8_t> lost_digits(const Verdicts& before, const Verdicts& after);

class Judge {
 public:
  // Learns from the training images; what is typical comes from the test images of even index, so that those
  // of odd index can control it. Throws InputError where the dataset has fewer images than the settings ask
  // for.
  Judge(const JudgeSettings& settings, const Dataset& dataset, Workers& workers);
  // A judge as saved, over the dataset it learned from.
  Judge(const Hdf5Reader& file, const Dataset& dataset, Workers& workers);
  void save(Hdf5Writer& file) const;

  // Judges images [n x 28 x 28].
  Verdicts judge(std::size_t n, const std::uint8_t* images, Workers& workers) const;

 private:
  void read_training_images(const LabelledImages& train, Workers& workers);

  JudgeSettings settings_;
  Rows features_;                     // [training_images x 324]
  std::vector<std::uint8_t> labels_;  // [training_images]
  RbfClassifier classifier_;
  double typical_distance_ = 0;
};

}  // namespace hbr::inline judge
