// The layers of a profile: its tables [layers.NAME], what they take from [defaults], and in which order they
// stand.
#pragma once

#include <string>
#include <vector>

#include "pipeline/core/settings.h"
#include "pipeline/hierarchy/layers.h"
#include "stages/layers/search_settings.h"

namespace hbr::inline stages {

struct LayerRow {
  std::string name;  // of the stage
  const LayerKind* kind = nullptr;
  std::string below;        // the layer that it is built on; "" for one that moves the joints itself
  nlohmann::json settings;  // of its kind, canonical
  SearchTable search;
};

// What a layer's table does not say it takes from [defaults.KIND], then from [defaults], where a key counts
// for every layer that has such a key. Those that the profile's `leave_out` names are not there. A layer
// stands after the one that it is built on. Throws InputError, with file, line and column, where a key, a
// kind or a layer below is not known, a key is missing, or layers stand on each other in a circle.
std::vector<LayerRow> layer_rows(const SettingsSource& profile);

}  // namespace hbr::inline stages
