// Refuses networks that learned nothing: a tanh latent easily gets stuck at its borders, after which every
// image decodes to the mean image.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hbr::net {

// latent: all coordinates of the test images; `mean_image_error`: what the mean training image would score on
// them. Throws InputError, led by `where` (seed and epoch), where more than 90 % of the coordinates are
// beyond 0.99 or, when `learned` (enough steps were made for it), the error is no better than 98 % of the
// mean image's.
void refuse_collapse(const std::vector<float>& latent, double test_error, double mean_image_error,
                     bool learned, const std::string& where);

}  // namespace hbr::net
