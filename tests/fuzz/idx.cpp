// Files of a dataset: IDX, plain or gzipped.
#include "models/dataset/idx.h"

#include <zlib.h>

#include "tests/fuzz/fuzz.h"

namespace hbr::fuzz {

std::vector<std::string> examples() {
  const std::string labels("\0\0\x08\x01\0\0\0\x03\x01\x02\x03", 11);
  const std::string images(
      "\0\0\x08\x03\0\0\0\x02\0\0\0\x02\0\0\0\x01"
      "abcd",
      20);
  const std::string packed = folder() / "packed";
  gzFile file = gzopen(packed.c_str(), "wb");
  gzwrite(file, images.data(), static_cast<unsigned>(images.size()));
  gzclose(file);
  return {labels, images, content_of_file(packed)};
}

void read(const std::string& bytes) {
  const std::size_t dimensions = bytes.size() % 2 ? 1 : 3;
  read_idx(written("idx", bytes), dimensions, "");
}

}  // namespace hbr::fuzz
