// The digits that a contender drew, from digit_verdicts/RR.h5.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace hbr::inline reports {

struct Drawings {
  std::vector<std::uint8_t> pixels;  // [n x 28 x 28]
  std::vector<float> measures;       // [n x d], latent position in [-1, 1]^d
  std::vector<float> objective;      // [n]
  std::vector<std::uint8_t> label;   // [n], the judge's class in 0..9
  std::vector<float> confidence;     // [n]
  std::vector<std::uint8_t> good;    // [n], 0 or 1

  std::size_t size() const { return objective.size(); }
  std::span<const std::uint8_t> image(std::size_t i) const { return {pixels.data() + i * 784, 784}; }
  // The first two coordinates of its position.
  std::pair<double, double> place(std::size_t i) const {
    const std::size_t dim = measures.size() / size();
    return {measures[dim * i], dim > 1 ? measures[dim * i + 1] : 0};
  }
};

bool has_drawings(const std::filesystem::path& path, const std::string& contender);

// `contender` is "hbr" or "flat". Throws InputError where the arrays do not agree or there is no digit.
Drawings read_drawings(const std::filesystem::path& path, const std::string& contender);

}  // namespace hbr::inline reports
