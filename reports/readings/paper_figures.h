// The figures that the paper gives, and how far a run is from them; reports/paper_figures.toml says what each
// key means and what a distance is.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace hbr::inline reports {

struct PaperFigure {
  std::string id, place, words;
  std::string kind, of, to;
  double median = 0;
  std::vector<double> quartiles;  // first and third, or none

  // In half the quartiles' distance, both logarithmic; x > 0.
  double distance(double x) const;
};

// Throws InputError: file, line, what was expected and found.
std::vector<PaperFigure> read_paper_figures(const std::filesystem::path& path);

// Root of the mean square, each at most kFarthest; nothing where one is missing, or all are.
inline constexpr double kFarthest = 10;
std::optional<double> distance_of_all(const std::vector<std::optional<double>>& distances);

}  // namespace hbr::inline reports
