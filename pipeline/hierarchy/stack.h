// Finished layers, one upon the other: a hierarchy that obeys.
#pragma once

#include <vector>

#include "pipeline/hierarchy/layer_model.h"

namespace hbr::inline hierarchy {

class Stack {
 public:
  // Puts a layer on top, which was made among the layers that the stack has now.
  void add(std::unique_ptr<LayerModel> model, const Elites& elites);

  int size() const { return static_cast<int>(levels_.size()); }
  const LayerModel& model(int level) const { return *levels_[level].model; }
  const Layer& layer(int level) const { return *levels_[level].layer; }
  // Throws InputError where the lowest layer does not consist of points.
  const PointLayer& points() const;
  const Layer& top() const { return *levels_.back().layer; }
  // The drawing area as the layer above the top sees it.
  const Frame& frame() const { return levels_.back().model->frame(); }

 private:
  struct Level {
    std::unique_ptr<LayerModel> model;
    std::unique_ptr<Layer> layer;
  };
  std::vector<Level> levels_;
};

}  // namespace hbr::inline hierarchy
