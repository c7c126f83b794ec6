// Adam (Kingma and Ba 2015) with its usual constants: decay 0.9 and 0.999, epsilon 1e-8.
#pragma once

#include <cstdint>

#include "models/autoencoder/network.h"
#include "pipeline/core/parallel.h"

namespace hbr::net {

struct Adam {
  explicit Adam(std::size_t parameters) : mean(parameters, 0.f), square(parameters, 0.f) {}

  void step(double rate, const float* gradient, Floats& parameters, Workers& workers);

  Floats mean, square;  // running means of the gradient and of its square
  std::int64_t steps = 0;
};

}  // namespace hbr::net
