#include "pipeline/hierarchy/stack.h"

#include "pipeline/core/check.h"

namespace hbr::inline hierarchy {

void Stack::add(std::unique_ptr<LayerModel> model, const Elites& elites) {
  std::unique_ptr<Layer> layer = model->finished(elites);
  levels_.push_back({std::move(model), std::move(layer)});
}

const PointLayer& Stack::points() const {
  const auto* points =
      levels_.empty() ? nullptr : dynamic_cast<const PointLayer*>(levels_.front().layer.get());
  if (!points) throw InputError("a stack of layers has no points at the bottom, by which the pen is moved");
  return *points;
}

}  // namespace hbr::inline hierarchy
