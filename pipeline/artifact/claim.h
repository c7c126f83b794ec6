// Who makes an output folder, said in a file of it: OUT/.plan/claim names host and process, and is touched
// now and then as long as they live. It holds between hosts, where the lock of lock.h may not (a network file
// system without locks).
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "pipeline/process/identity.h"

namespace hbr::inline artifact {

// How often a sign of life is given, and how old the last may be. On its own host a process is looked at
// instead.
constexpr std::chrono::seconds kHeartbeat{20}, kSilence{300};

// Claims the folder for a process. Says on stderr where it takes the place of one that is gone; throws
// InputError where another holder lives.
void claim_folder(const std::filesystem::path& out, const Process& holder);

// What stands in the claim; empty where there is none.
std::string claim_of(const std::filesystem::path& out);

// In a process of its own, the child of `holder`: gives signs of life until the holder has ended, then leaves
// the claim and ends. Where another took the claim meanwhile (this host was silent for too long) the holder
// is ended. A hangup or interrupt signal only makes it look at once.
[[noreturn]] void keep_claim(const std::filesystem::path& out, const Process& holder);

}  // namespace hbr::inline artifact
