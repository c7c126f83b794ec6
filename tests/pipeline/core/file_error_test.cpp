#include "pipeline/core/file_error.h"

#include <gtest/gtest.h>

#include <cerrno>
#include <string>

namespace hbr {
namespace {

TEST(FileError, SaysWhatToDo) {
  const auto said = [](int error) {
    return std::string(file_error("/nosuch/folder/file", "can't write", error).what());
  };
  const std::pair<int, const char*> remedies[] = {
      {ENOSPC, "No space left on device; make room, or use a place on another disk"},
      {EDQUOT, "; your quota there is used up: remove files, or use another place"},
      {EROFS, "; the file system can only be read: use another place"},
      {EACCES, "; you may not do this there: ask its owner, or use another place"},
      {EPERM, "; you may not do this there: ask its owner, or use another place"},
      {ENOENT, "; a folder above it is not there"},
      {ENOTDIR, "; something above it is no folder: remove that, or use another place"},
      {EISDIR, "; something else stands in its place: remove it, or use another place"},
      {ENAMETOOLONG, "; use a place with a shorter path"},
      {EFBIG, "; a limit on the size of files is set (ulimit -f): raise it"},
      {EMFILE, "; too many files are open (ulimit -n): raise the limit, or run fewer jobs at once"},
      {ELOOP, "; its symbolic links lead back to themselves: remove them"},
      {EIO, "; the disk or its server fails: see the system's log"},
      {EINTR, "Interrupted system call"},
  };
  for (const auto& [error, remedy] : remedies) {
    EXPECT_TRUE(said(error).starts_with("/nosuch/folder/file: can't write: ")) << said(error);
    EXPECT_TRUE(said(error).ends_with(remedy)) << said(error);
  }
  EXPECT_EQ(std::string(file_error("/file", "can't read", ENOENT).what()),
            "/file: can't read: No such file or directory");
  EXPECT_EQ(std::string(file_error("file", "can't read", ENOENT).what()),
            "file: can't read: No such file or directory");
}

TEST(FileError, OfTwoPathsNamesWhereItGoes) {
  const std::error_code full(ENOSPC, std::generic_category());
  const auto said = [](const std::filesystem::filesystem_error& error) {
    return std::string(file_error(error).what());
  };
  EXPECT_TRUE(said({"rename", "/a", "/b", full}).starts_with("/b: ")) << said({"rename", "/a", "/b", full});
  EXPECT_TRUE(said({"remove", "/a", full}).starts_with("/a: ")) << said({"remove", "/a", full});
}

}  // namespace
}  // namespace hbr
