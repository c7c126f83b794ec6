#include "pipeline/hierarchy/layers/digits.h"

#include "pipeline/core/check.h"
#include "pipeline/hierarchy/layers/arc_geometry.h"
#include "pipeline/hierarchy/layers/image_outcome.h"
#include "pipeline/hierarchy/stack.h"

namespace hbr::inline hierarchy {
namespace {

OutOfRange out_of_range(const std::string& name) {
  return name == "radius" ? OutOfRange::kRadius : name == "axes" ? OutOfRange::kAxes : OutOfRange::kReject;
}

}  // namespace

std::optional<Eigen::Vector3d> decode_arc(const Frame& frame, OutOfRange out_of_range, const float* genes) {
  const double most = frame.half_side;
  Eigen::Vector2d centre = frame.point(Eigen::Vector2d(genes[0], genes[1]));
  if (out_of_range == OutOfRange::kReject && centre.norm() > most) return std::nullopt;
  centre = out_of_range == OutOfRange::kAxes ? centre.cwiseMax(-most).cwiseMin(most).eval()
                                             : at_most(centre, most);
  centre = frame.point_descriptor(centre);
  return Eigen::Vector3d(centre.x(), centre.y(), genes[2]);
}

int DigitDecoder::decode(const float* genome, int length, double* commands) const {
  int arcs = 0;
  for (int at = kHead; at < length; at += kBlock, ++arcs) {
    const auto arc = decode_arc(frame_, out_of_range_, genome + at);
    if (!arc) return 0;
    Eigen::Vector3d::Map(commands + 3 * arcs) = *arc;
  }
  return arcs;
}

std::optional<PenPlacement> DigitDecoder::placement(const float* genome) const {
  return PenPlacement{frame_.point(Eigen::Vector2d(genome[0], genome[1])), genome[2]};
}

std::unique_ptr<LayerModel> make_digits(const DigitsSettings& settings, const Surroundings& around) {
  StackedParts digits;
  digits.frame = around.below->frame();
  Coordinates head = plane_coordinates("start", digits.frame.half_side);
  head.push_back(pen_width(settings.pencil));
  digits.genome = {head, arc_coordinates(digits.frame), DigitDecoder::kMaxArcs, settings.length_rate};
  digits.fitness = image_fitness();
  digits.decoder = std::make_unique<DigitDecoder>(digits.frame, out_of_range(settings.out_of_range));
  digits.way = {true, settings.line_spacing, way_points_of(settings.way_points)};
  if (around.descriptor) {
    digits.descriptor = latent_coordinates(*around.descriptor);
    digits.outcome = std::make_unique<ImageOutcome>(*around.descriptor, settings.pencil, digits.way);
  }
  digits.images = 1;
  digits.draw = [pencil = settings.pencil](const Executions& executions, int execution, float* image) {
    draw_stroke(executions, execution, 0, pencil, image);
  };
  return stacked_model(around, std::move(digits));
}

}  // namespace hbr::inline hierarchy
