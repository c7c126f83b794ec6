#include "models/autoencoder/adam.h"

#include <cmath>

namespace hbr::net {

void Adam::step(double rate, const float* gradient, Floats& parameters, Workers& workers) {
  constexpr float keep1 = 0.9f, keep2 = 0.999f, epsilon = 1e-8f;
  ++steps;
  // Both running means start at zero; the corrections make up for it.
  const double n = static_cast<double>(steps);
  const float step = static_cast<float>(rate / (1 - std::pow(0.9, n)));
  const float correction = static_cast<float>(1 / (1 - std::pow(0.999, n)));
  float *m = mean.data(), *s = square.data(), *p = parameters.data();
  workers.for_ranges(parameters.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      m[i] = keep1 * m[i] + (1 - keep1) * gradient[i];
      s[i] = keep2 * s[i] + (1 - keep2) * gradient[i] * gradient[i];
      p[i] -= step * m[i] / (std::sqrt(s[i] * correction) + epsilon);
    }
  });
}

}  // namespace hbr::net
