#include "reports/figures/drawings.h"

#include <algorithm>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"

namespace hbr::inline reports {

bool has_drawings(const std::filesystem::path& path, const std::string& contender) {
  return Hdf5Reader(path).has(contender + "/image");
}

Drawings read_drawings(const std::filesystem::path& path, const std::string& contender) {
  const Hdf5Reader file(path);
  const auto image = file.read<std::uint8_t>(contender + "/image");
  if (image.shape.size() != 3 || image.shape[0] == 0 || image.shape[1] != 28 || image.shape[2] != 28)
    throw InputError("{}: {}/image is not n x 28 x 28 with n > 0", path.string(), contender);
  const std::size_t n = image.shape[0];
  const auto array = [&]<class T>(const char* name, T) {
    auto values = file.read<T>(contender + "/" + name).values;
    if (values.size() != n)
      throw InputError("{}: {}/{} has {} numbers; expected {}, one for each image", path.string(), contender,
                       name, values.size(), n);
    return values;
  };
  const auto measures = file.read<float>(contender + "/measures");
  if (measures.shape.size() != 2 || measures.shape[0] != n || measures.shape[1] == 0)
    throw InputError("{}: {}/measures has {} numbers; expected a position for each of {} images",
                     path.string(), contender, measures.values.size(), n);
  Drawings drawings{image.values,
                    measures.values,
                    array("objective", float{}),
                    array("label", std::uint8_t{}),
                    array("confidence", float{}),
                    array("good", std::uint8_t{})};
  if (std::ranges::any_of(drawings.label, [](std::uint8_t label) { return label > 9; }))
    throw InputError("{}: {}/label holds a class above 9", path.string(), contender);
  return drawings;
}

}  // namespace hbr::inline reports
