// Finished layers, read from their artifacts, which tell themselves what they are.
#pragma once

#include "pipeline/artifact/stage.h"
#include "pipeline/hierarchy/stack.h"

namespace hbr::inline stages {

// A layer's elites, and what they are.
struct StoredLayer {
  std::string kind;
  Elites elites;
  std::unique_ptr<LayerModel> model;
};

struct StackOnBody {
  std::unique_ptr<Robot> body;
  Stack stack;
  std::vector<std::string> kinds;  // of each level, the lowest first
  std::vector<Elites> elites;

  const LayerModel& top() const { return stack.model(stack.size() - 1); }
  // The level of a kind; throws InputError where there is none.
  int level(const std::string& kind) const;
};

// The stage's input `name`, a layer that may be put on top of the stack whatever it was evolved on. A stack
// without a level gets the body of the layer. The descriptor is for layers that are to be evaluated by it.
StoredLayer read_layer(const StageRun& stage, const std::string& name, StackOnBody& below,
                       const Descriptor* descriptor = nullptr);
// Puts it on top.
void add_layer(StackOnBody& stack, StoredLayer layer);
// The stage's inputs NAME1, NAME2, ..., the lowest layer first.
StackOnBody read_stack(const StageRun& stage, const std::string& name,
                       const Descriptor* descriptor = nullptr);

}  // namespace hbr::inline stages
