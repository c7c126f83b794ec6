// Layer 4, digits (paper, section 4.3): a start and one to three arcs, drawn as an image and judged by a
// learned descriptor.
#pragma once

#include <optional>

#include "pipeline/hierarchy/drawing_settings.h"
#include "pipeline/hierarchy/execution_settings.h"
#include "pipeline/hierarchy/stacked_model.h"

namespace hbr::inline hierarchy {

struct DigitsSettings {
  double line_spacing = 0;
  std::string out_of_range;
  double length_rate = 0;
  PencilSettings pencil;
  std::string way_points = {};
};
template <class Fields>
void describe(Fields& f, DigitsSettings& s) {
  f.number("line_spacing", s.line_spacing, Range{0, 10},
           "distance between the points of a line at which layer 1 is asked, m; 0: at its end alone");
  describe_way_points(f, s.way_points);
  f.choice(
      "out_of_range", s.out_of_range, {"radius", "axes", "reject"},
      "of a triplet whose centre is farther than L: brought back along its direction, its coordinates one "
      "by one, or no digit");
  describe_length_rate(f, s.length_rate);
  f.table("pencil", s.pencil, "from trace to image");
}

// What becomes of a wanted centre farther than L, where no arc of layer 3 has its own: brought back along its
// direction likewise, each of its coordinates brought into [-L, L] (genes in [0, 1] never leave it, so the
// look-up finds the stored arc nearest to a corner of the square), or nothing that can be drawn.
enum class OutOfRange { kRadius, kAxes, kReject };

// The place of layer 3's descriptor that three genes in [0, 1] mean; none where it is rejected.
std::optional<Eigen::Vector3d> decode_arc(const Frame& frame, OutOfRange out_of_range, const float* genes);

// Genome: start x and y (through layer 1), pen width, then one to three triplets, each a place of layer 3's
// descriptor.
class DigitDecoder final : public Decoder {
 public:
  static constexpr int kHead = 3, kBlock = 3, kMaxArcs = 3;
  DigitDecoder(const Frame& frame, OutOfRange out_of_range) : frame_(frame), out_of_range_(out_of_range) {}
  int command_size() const override { return 3; }
  int max_commands() const override { return kMaxArcs; }
  int decode(const float* genome, int length, double* commands) const override;
  bool places() const override { return true; }
  std::optional<PenPlacement> placement(const float* genome) const override;

 private:
  Frame frame_;
  OutOfRange out_of_range_;
};

std::unique_ptr<LayerModel> make_digits(const DigitsSettings& settings, const Surroundings& around);

}  // namespace hbr::inline hierarchy
