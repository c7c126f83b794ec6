// Keys that profiles had before layers were tables.
#pragma once

#include "pipeline/core/settings.h"

namespace hbr::inline stages {

// Throws InputError, with file, line and column, where the profile has one: what to write instead.
void refuse_old_keys(const SettingsSource& profile);

}  // namespace hbr::inline stages
