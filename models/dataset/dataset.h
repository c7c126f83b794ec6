// Images of digits with their labels: MNIST, or any dataset of the same shape.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/drawing/draw.h"

namespace hbr::inline dataset {

inline constexpr int kClasses = 10;

struct LabelledImages {
  std::vector<std::uint8_t> images;  // [n x 28 x 28], white (255) on black
  std::vector<std::uint8_t> labels;  // [n], 0 to 9

  std::size_t size() const { return labels.size(); }
  const std::uint8_t* image(std::size_t i) const { return &images[i * kImagePixels]; }
};

struct Dataset {
  std::string name;
  LabelledImages train, test;
};

// What MNIST's four files are called, in the order train images, train labels, test images, test labels.
inline constexpr std::array<const char*, 4> kIdxFiles = {"train-images-idx3-ubyte", "train-labels-idx1-ubyte",
                                                         "t10k-images-idx3-ubyte", "t10k-labels-idx1-ubyte"};

// Reads the four files, plain or gzipped, from a folder. sha256 holds the hashes of their unpacked content,
// in the order of kIdxFiles, or nothing. Throws InputError, naming the file, for what read_idx refuses,
// images that are not 28 x 28, none at all, labels above 9, counts that disagree.
Dataset read_idx_folder(const std::string& name, const std::filesystem::path& folder,
                        const std::vector<std::string>& sha256);

// dataset.h5, see FORMAT.md. Reading throws InputError where shapes or labels are not as there.
void write_dataset(Hdf5Writer& file, const Dataset& dataset);
Dataset read_dataset(const std::filesystem::path& path);

}  // namespace hbr::inline dataset
