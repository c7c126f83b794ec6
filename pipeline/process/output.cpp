#include "pipeline/process/output.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "pipeline/process/bytes.h"

namespace hbr::inline process {
namespace {

// A file in memory rather than a pipe: no program can block on a full pipe that nobody reads.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& content = "") : number_(::memfd_create("hbr", MFD_CLOEXEC)) {
    if (number_ < 0 || !write_all(number_, content)) {
      const int reason = errno;
      ::close(number_);
      throw std::system_error(reason, std::generic_category(), "no file in memory can be made");
    }
    rewind();
  }
  ~MemoryFile() { ::close(number_); }
  MemoryFile(const MemoryFile&) = delete;

  int number() const { return number_; }
  std::string content() const {
    rewind();
    return read_all(number_);
  }

 private:
  void rewind() const { ::lseek(number_, 0, SEEK_SET); }

  int number_;
};

}  // namespace

Output output_of(const Program& program, const std::string& input) {
  const MemoryFile in(input), out, errors;
  const Ending ending = wait_for(start_program(program, {in.number(), out.number(), errors.number()}));
  return {ending, out.content(), errors.content()};
}

}  // namespace hbr::inline process
