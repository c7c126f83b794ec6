// Every key of a profile, for people: what the profile says, what may be said, what it means.
#pragma once

#include <string>

#include "pipeline/core/settings.h"

namespace hbr::inline stages {

// A table of the profile after the other, after them what each kind of layers asks for, a line a key, and
// what the profile's layers say of it. "..." where there is no value that all of them have.
std::string profile_keys(const SettingsSource& profile);

}  // namespace hbr::inline stages
