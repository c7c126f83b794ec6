#include "reports/figures/gallery.h"

#include <fmt/format.h>

#include "reports/plot/picture.h"

namespace hbr::inline reports {

Panel gallery_panel(const std::string& title, const std::vector<GalleryRow>& rows) {
  constexpr int kSide = 84;
  constexpr double kWidth = 500, kEdge = 52, kCell = (kWidth - kEdge) / kGalleryColumns;
  std::string labels;
  InkSheet sheet(static_cast<int>(kGalleryColumns) * kSide, kSide * static_cast<int>(rows.size()));
  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double middle = static_cast<double>(r) + 0.5;
    for (std::size_t k = 0; k < rows[r].images.size(); ++k)
      if (!rows[r].images[k].empty())
        sheet.place(rows[r].images[k], (static_cast<double>(k) + 0.5) * kSide, middle * kSide, kSide);
    labels += svg_text(rows[r].label, 0, middle * kCell + 4, 13, rows[r].colour, Align::left);
  }
  const double height = static_cast<double>(rows.size()) * kCell;
  std::string names;
  for (const GalleryRow& row : rows) names += (names.empty() ? "" : ", ") + row.label;
  return {
      title,
      Drawing{kWidth, height, sheet.svg_image(kEdge, 0, kGalleryColumns * kCell, height) + labels,
              fmt::format("{} digits side by side, a row for each of: {}.", rows[0].images.size(), names)},
      3};
}

}  // namespace hbr::inline reports
