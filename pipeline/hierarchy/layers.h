// The kinds of layers by name. To add one: its file in layers/, and its row in layers.cpp.
#pragma once

#include "pipeline/hierarchy/layer_kind.h"

namespace hbr::inline hierarchy {

std::span<const LayerKind> layer_kinds();
// Throws InputError for another name.
const LayerKind& layer_kind(const std::string& name);

}  // namespace hbr::inline hierarchy
