// Digits side by side, in rows of the same digits by different hands.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reports/plot/figure.h"

namespace hbr::inline reports {

inline constexpr std::size_t kGalleryColumns = 8;

struct GalleryRow {
  std::string label;
  Colour colour = Colour::grey;
  std::vector<std::vector<std::uint8_t>> images = {};  // [784] each, at most kGalleryColumns; empty: a gap
};

// Three of the six columns of a figure's row wide.
Panel gallery_panel(const std::string& title, const std::vector<GalleryRow>& rows);

}  // namespace hbr::inline reports
