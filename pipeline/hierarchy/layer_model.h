// A layer of a stack: how it is evolved, and how it obeys once it is. The kinds of pipeline/hierarchy/layers
// make them from their settings.
#pragma once

#include <memory>

#include "pipeline/hierarchy/coordinate.h"
#include "pipeline/hierarchy/descriptor.h"
#include "pipeline/hierarchy/frame.h"
#include "pipeline/hierarchy/layer_evaluator.h"
#include "pipeline/hierarchy/robot.h"

namespace hbr::inline hierarchy {

class Stack;

// What a layer is made among. All have to outlive it.
struct Surroundings {
  const Robot& robot;
  const Stack* below = nullptr;  // the finished layers below; none: the layer moves the joints itself
  const Descriptor* descriptor = nullptr;  // learned, for a layer that asks for one in order to be evolved
};

// A head of genes, then, where genomes differ in length, one to `most_blocks` blocks.
struct GenomeShape {
  Coordinates head;
  Coordinates block = {};
  int most_blocks = 0;
  double length_rate = 0;  // probability that a child has a block more or less
  // Genes of one with that many blocks; of the longest.
  int genes(int blocks) const { return static_cast<int>(head.size()) + blocks * block_genes(); }
  int genes() const { return genes(most_blocks); }
  int block_genes() const { return static_cast<int>(block.size()); }
  bool fixed() const { return most_blocks == 0; }
  // Of all genes of the longest.
  Coordinates coordinates() const {
    Coordinates all = head;
    for (int k = 1; k <= most_blocks; ++k) append(all, "block " + std::to_string(k) + " ", block);
    return all;
  }
};

class LayerModel {
 public:
  virtual ~LayerModel() = default;
  virtual GenomeShape genome() const = 0;
  // What is searched. A layer that was made without the learned descriptor that it asks for has none.
  virtual const Evaluator& evaluator() const = 0;
  // Range of its descriptor, the same in every dimension.
  virtual float low() const { return 0; }
  virtual float high() const { return 1; }
  // What each dimension of it is, and what the fitness is. Of a layer that was made without the learned
  // descriptor that it asks for the first is empty.
  virtual const Coordinates& descriptor() const = 0;
  virtual const FitnessMeaning& fitness() const = 0;
  // As the layers above see the drawing area.
  virtual const Frame& frame() const = 0;
  // Obeys by these elites. A layer without any below it, points aside, can't be built on.
  virtual std::unique_ptr<Layer> finished(const Elites& elites) const = 0;
  // Executes its genomes, and what many executions of one come to; none where the layer has none below, or
  // where its descriptor is not stochastic.
  virtual const Executor* executor() const { return nullptr; }
  virtual const SampledOutcome* sampled_outcome() const { return nullptr; }
  // Images that a genome draws, each 28 x 28: their number, and the images. An impossible genome draws
  // nothing.
  virtual int images() const { return 0; }
  virtual void draw(const float* /*genome*/, int /*length*/, float* /*images*/) const {}
};

}  // namespace hbr::inline hierarchy
