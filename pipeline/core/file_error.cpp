#include "pipeline/core/file_error.h"

#include <sys/statvfs.h>

#include <cerrno>
#include <system_error>

namespace hbr::inline core {
namespace {

namespace fs = std::filesystem;

// The file system is full of files rather than of bytes. (Some have no count of them: files 0.)
bool lacks_inodes(fs::path path) {
  struct statvfs system {};
  while (::statvfs(path.c_str(), &system) != 0) {  // the path itself may not be there
    if (!path.has_relative_path() || path.parent_path() == path) return false;
    path = path.parent_path();
  }
  return system.f_files > 0 && system.f_favail == 0 && system.f_bavail > 0;
}

std::string remedy(const fs::path& path, int error) {
  std::error_code ignored;
  switch (error) {
    case ENOSPC:
      return lacks_inodes(path) ? "no inodes are left there: remove files, or use a place on another disk"
                                : "make room, or use a place on another disk";
    case EDQUOT:
      return "your quota there is used up: remove files, or use another place";
    case EROFS:
      return "the file system can only be read: use another place";
    case EACCES:
    case EPERM:
      return "you may not do this there: ask its owner, or use another place";
    case ENOENT:
      return path.parent_path().empty() || fs::is_directory(path.parent_path(), ignored)
                 ? ""
                 : "a folder above it is not there";
    case ENOTDIR:
      return "something above it is no folder: remove that, or use another place";
    case EISDIR:
    case EEXIST:
    case EINVAL:  // a pipe has no length to cut
      return "something else stands in its place: remove it, or use another place";
    case ENAMETOOLONG:
      return "use a place with a shorter path";
    case EFBIG:
      return "a limit on the size of files is set (ulimit -f): raise it";
    case EMFILE:
    case ENFILE:
      return "too many files are open (ulimit -n): raise the limit, or run fewer jobs at once";
    case ELOOP:
      return "its symbolic links lead back to themselves: remove them";
    case EIO:
    case ESTALE:
      return "the disk or its server fails: see the system's log";
    default:
      return "";
  }
}

}  // namespace

InputError file_error(const fs::path& path, const char* what, int error) {
  const std::string advice = remedy(path, error);
  return InputError("{}: {}: {}{}{}", path.string(), what, std::generic_category().message(error),
                    advice.empty() ? "" : "; ", advice);
}

InputError file_error(const fs::filesystem_error& error) {
  // Of a copy or a rename the second path is where it goes to, where most faults are.
  const fs::path& path = error.path2().empty() ? error.path1() : error.path2();
  return file_error(path, "can't use this file or folder", error.code().value());
}

}  // namespace hbr::inline core
