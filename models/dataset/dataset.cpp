#include "models/dataset/dataset.h"

#include <fmt/ranges.h>

#include <algorithm>

#include "models/dataset/idx.h"
#include "pipeline/core/check.h"

namespace hbr::inline dataset {
namespace {

// What holds for images and labels wherever they come from; `where` names each in an error.
LabelledImages checked(std::vector<std::size_t> image_shape, std::vector<std::uint8_t> images,
                       std::vector<std::uint8_t> labels, const std::string& images_where,
                       const std::string& labels_where) {
  if (image_shape.size() != 3 || image_shape[1] != kImageSide || image_shape[2] != kImageSide)
    throw InputError("{}: expected n images of {} x {} pixels, found an array of {}", images_where,
                     kImageSide, kImageSide, fmt::join(image_shape, " x "));
  if (image_shape[0] == 0) throw InputError("{}: holds no image; expected at least one", images_where);
  if (labels.size() != image_shape[0])
    throw InputError("{}: expected {} labels, one for each image of {}, found {}", labels_where,
                     image_shape[0], images_where, labels.size());
  const auto above = std::find_if(labels.begin(), labels.end(), [](int label) { return label >= kClasses; });
  if (above != labels.end())
    throw InputError("{}: label {} is {}; expected 0 to {}", labels_where, above - labels.begin(), *above,
                     kClasses - 1);
  return {std::move(images), std::move(labels)};
}

LabelledImages read_part(const Hdf5Reader& file, const std::string& part) {
  auto images = file.read<std::uint8_t>(part + "/images");
  auto labels = file.read<std::uint8_t>(part + "/labels");
  const std::string where = file.path().string() + ": " + part;
  return checked(std::move(images.shape), std::move(images.values), std::move(labels.values),
                 where + "/images", where + "/labels");
}

void write_part(Hdf5Writer& file, const std::string& part, const LabelledImages& data) {
  file.write(part + "/images", {data.size(), kImageSide, kImageSide}, data.images.data());
  file.write(part + "/labels", data.labels);
}

}  // namespace

Dataset read_idx_folder(const std::string& name, const std::filesystem::path& folder,
                        const std::vector<std::string>& sha256) {
  if (!sha256.empty() && sha256.size() != kIdxFiles.size())
    throw InputError("dataset {}: expected {} sha256 texts ({}) or none, found {}", name, kIdxFiles.size(),
                     fmt::join(kIdxFiles, ", "), sha256.size());
  const auto part = [&](std::size_t first) {
    const auto hash = [&](std::size_t i) { return sha256.empty() ? "" : sha256[i]; };
    Idx images = read_idx(folder / kIdxFiles[first], 3, hash(first));
    Idx labels = read_idx(folder / kIdxFiles[first + 1], 1, hash(first + 1));
    return checked(std::move(images.shape), std::move(images.values), std::move(labels.values),
                   images.path.string(), labels.path.string());
  };
  return {name, part(0), part(2)};
}

void write_dataset(Hdf5Writer& file, const Dataset& dataset) {
  file.attribute("name", dataset.name);
  write_part(file, "train", dataset.train);
  write_part(file, "test", dataset.test);
}

Dataset read_dataset(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  return {file.text_attribute("name"), read_part(file, "train"), read_part(file, "test")};
}

}  // namespace hbr::inline dataset
