// Of judged digits those that a reader is shown.
#pragma once

#include <cstdint>
#include <vector>

namespace hbr::inline judge {

// What the judge says of images [n]: see judge.h.
struct JudgedDigits {
  std::vector<std::uint8_t> label, good;
  std::vector<float> confidence;
};

// Of each class that the judge finds, in their order: the digit, among the good ones where there are any,
// with the greatest confidence; of several the first.
std::vector<std::size_t> surest_of_each_class(const JudgedDigits& digits);

// Of the good ones that are neither 0 nor 1, which are too plain, where there are any, else of all: the digit
// with the greatest confidence; of several the first. There is at least one.
std::size_t most_legible(const JudgedDigits& digits);

}  // namespace hbr::inline judge
