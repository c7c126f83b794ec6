// Every key of a profile, for people: what the profile says, what may be said, what it means.
#pragma once

#include <string>

#include "pipeline/core/settings.h"

namespace hbr::inline stages {

// A table of the profile after the other, and after them what each kind of layers asks for; a line a key.
std::string profile_keys(const SettingsSource& profile);

}  // namespace hbr::inline stages
