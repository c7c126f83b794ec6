// A small dataset in MNIST's format, in a folder of its own that goes with the test.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "models/dataset/dataset.h"

namespace hbr {

using Bytes = std::vector<std::uint8_t>;

inline Bytes idx_bytes(const std::vector<std::uint32_t>& shape, const Bytes& values) {
  Bytes bytes{0, 0, 8, static_cast<std::uint8_t>(shape.size())};
  for (const std::uint32_t size : shape)
    for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(size >> shift));
  bytes.insert(bytes.end(), values.begin(), values.end());
  return bytes;
}

class IdxFolder : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() / ("hbr_" + std::string(test->test_suite_name()) + "_" +
                                                        test->name() + "_" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    train_ = made(30, 1);
    test_ = made(20, 2);
    write_part(0, train_);
    write_part(2, test_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  static LabelledImages made(std::size_t n, std::uint32_t state) {
    LabelledImages data;
    for (std::size_t i = 0; i < n; ++i) data.labels.push_back(static_cast<std::uint8_t>(i % kClasses));
    for (std::size_t i = 0; i < n * kImagePixels; ++i) {
      state = state * 1664525 + 1013904223;
      data.images.push_back(static_cast<std::uint8_t>(state >> 24));
    }
    return data;
  }
  void write_part(std::size_t first, const LabelledImages& data) {
    const auto n = static_cast<std::uint32_t>(data.size());
    write(kIdxFiles[first], idx_bytes({n, 28, 28}, data.images));
    write(kIdxFiles[first + 1], idx_bytes({n}, data.labels));
  }
  void write(const std::string& name, const Bytes& bytes) {
    std::ofstream(folder_ / name, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
  Bytes read(const std::string& name) {
    std::ifstream file(folder_ / name, std::ios::binary);
    return Bytes(std::istreambuf_iterator<char>(file), {});
  }
  void pack(const std::string& name) {
    const Bytes bytes = read(name);
    const gzFile file = gzopen((folder_ / (name + ".gz")).c_str(), "wb");
    ASSERT_EQ(gzwrite(file, bytes.data(), static_cast<unsigned>(bytes.size())),
              static_cast<int>(bytes.size()));
    gzclose(file);
    std::filesystem::remove(folder_ / name);
  }

  std::filesystem::path folder_;
  LabelledImages train_, test_;
};

}  // namespace hbr
