// What every descriptor promises.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <thread>
#include <vector>

#include "models/descriptor/reconstructing_descriptor.h"

namespace hbr {

struct Described {
  std::vector<float> position, error;
  bool operator==(const Described&) const = default;
};

inline Described describe(const Descriptor& descriptor, const Rows& images) {
  const auto n = static_cast<std::size_t>(images.rows());
  Described d{std::vector<float>(n * static_cast<std::size_t>(descriptor.dimension())),
              std::vector<float>(n)};
  descriptor.describe(images.rows(), images.data(), d.position.data(), d.error.data());
  return d;
}

// Bit for bit: an image by itself, in batches of any size, and in two threads.
inline void expect_images_stand_alone(const Descriptor& descriptor, const Rows& images) {
  Described alone;
  for (Eigen::Index i = 0; i < images.rows(); ++i) {
    const Described one = describe(descriptor, images.row(i));
    alone.position.insert(alone.position.end(), one.position.begin(), one.position.end());
    alone.error.insert(alone.error.end(), one.error.begin(), one.error.end());
  }
  for (const Eigen::Index n : {2, 7, 17}) {
    const Eigen::Index first = images.rows() - n;
    const Described some = describe(descriptor, images.bottomRows(n));
    EXPECT_TRUE(std::equal(some.position.begin(), some.position.end(),
                           alone.position.begin() + first * descriptor.dimension()));
    EXPECT_TRUE(std::equal(some.error.begin(), some.error.end(), alone.error.begin() + first));
  }
  Described other;
  std::thread thread([&] { other = describe(descriptor, images); });
  EXPECT_TRUE(describe(descriptor, images) == alone);
  thread.join();
  EXPECT_TRUE(other == alone);
}

template <class Made>
Made read_back(const Made& made, const std::filesystem::path& path) {
  Hdf5Writer file(path);
  made.write(file);
  file.close();
  return Made(Hdf5Reader(path));
}

}  // namespace hbr
