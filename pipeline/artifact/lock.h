// One make at a time on one output folder. The lock lives in a process and a child that keeps its claim
// (claim.h) and ends with it: when they have ended, be it by kill -9, the lock is gone, and there is nothing
// to remove.
#pragma once

#include <filesystem>

namespace hbr::inline artifact {

// Takes the lock OUT/.plan/lock and the claim, and keeps them through exec; makes OUT where it is missing.
// Throws InputError where the folder can't be written or another process holds one of them.
void lock_folder(const std::filesystem::path& out);

// In a process that the holder of the lock started: lets go of it, so that it ends with its holder.
void leave_lock_to_parent();

}  // namespace hbr::inline artifact
