#include "models/autoencoder/collapse.h"

#include <algorithm>
#include <cmath>

#include "pipeline/core/check.h"

namespace hbr::net {

void refuse_collapse(const std::vector<float>& latent, double test_error, double mean_image_error,
                     bool learned, const std::string& where) {
  const auto stuck = std::count_if(latent.begin(), latent.end(), [](float z) { return std::abs(z) > 0.99f; });
  const double share = static_cast<double>(stuck) / static_cast<double>(latent.size());
  const char* mend =
      "try another seed, a lower learning_rate or another output_bias (about the logit of the "
      "images' mean brightness; of a linear output about the mean brightness)";
  if (share > 0.9)
    throw InputError(
        "{}: the autoencoder collapsed: {:.1f} % of the latent coordinates are beyond 0.99, at most "
        "90 % expected; {}",
        where, 100 * share, mend);
  if (learned && test_error > 0.98 * mean_image_error)
    throw InputError("{}: the autoencoder collapsed: its error {:.4f} is that of the mean image, {:.4f}; {}",
                     where, test_error, mean_image_error, mend);
}

}  // namespace hbr::net
