// The model of a layer without any below it, which moves the joints itself and can't be built on.
#pragma once

#include <functional>

#include "pipeline/hierarchy/layer_model.h"

namespace hbr::inline hierarchy {

struct FlatParts {
  GenomeShape genome;
  Coordinates descriptor;
  FitnessMeaning fitness;
  Frame frame;
  std::unique_ptr<Evaluator> evaluator;  // none where the layer is only looked at
  float low = 0, high = 1;
  int images = 0;
  std::function<void(const float* genome, int length, float* images)> draw = nullptr;
};

// `kind` names it in the error of whoever would build on it.
std::unique_ptr<LayerModel> flat_model(const char* kind, FlatParts parts);

}  // namespace hbr::inline hierarchy
