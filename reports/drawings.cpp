#include "reports/drawings.h"

#include <algorithm>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"

namespace hbr {

bool has_drawings(const std::filesystem::path& path, const std::string& contender) {
  return Hdf5Reader(path).has(contender + "/image");
}

Drawings read_drawings(const std::filesystem::path& path, const std::string& contender) {
  const Hdf5Reader file(path);
  const auto image = file.read<std::uint8_t>(contender + "/image");
  if (image.shape.size() != 3 || image.shape[0] == 0 || image.shape[1] != 28 || image.shape[2] != 28)
    throw InputError("{}: {}/image is not n x 28 x 28 with n > 0", path.string(), contender);
  const std::size_t n = image.shape[0];
  const auto array = [&]<class T>(const char* name, std::size_t columns, T) {
    auto values = file.read<T>(contender + "/" + name).values;
    if (values.size() != n * columns)
      throw InputError("{}: {}/{} has {} numbers; expected {} for {} images", path.string(), contender, name,
                       values.size(), n * columns, n);
    return values;
  };
  Drawings drawings{image.values,
                    array("measures", 2, float{}),
                    array("objective", 1, float{}),
                    array("label", 1, std::uint8_t{}),
                    array("confidence", 1, float{}),
                    array("good", 1, std::uint8_t{})};
  if (std::ranges::any_of(drawings.label, [](std::uint8_t label) { return label > 9; }))
    throw InputError("{}: {}/label holds a class above 9", path.string(), contender);
  return drawings;
}

}  // namespace hbr
