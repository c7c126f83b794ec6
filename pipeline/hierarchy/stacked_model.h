// The model of a layer that is built on others: a decoder, an outcome, and how often a genome is executed.
#pragma once

#include <functional>

#include "pipeline/hierarchy/layer_model.h"

namespace hbr::inline hierarchy {

struct StackedParts {
  GenomeShape genome;
  Coordinates descriptor;
  FitnessMeaning fitness;
  Frame frame;  // for the layers above
  std::unique_ptr<Decoder> decoder;
  // One of the two, or none where the layer is only executed.
  std::unique_ptr<Outcome> outcome;
  std::unique_ptr<SampledOutcome> sampled;
  int samples = 1;
  SampleFitness sample_fitness = SampleFitness::kNearest;
  Starts starts = {};
  Way way = {};
  // How far beyond its elites the commands of layers above are looked up fast, in units of its descriptor.
  float slack = 0.01f;
  // Images of an execution [images x 28 x 28].
  int images = 0;
  std::function<void(const Executions&, int execution, float* images)> draw = nullptr;
};

std::unique_ptr<LayerModel> stacked_model(const Surroundings& around, StackedParts parts);

}  // namespace hbr::inline hierarchy
