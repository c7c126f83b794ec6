// Layer 5, numbers: some digits written from left to right by commands to layer 4. A genome names, for each
// digit, a place in layer 4's descriptor space and where on the paper it is written; the arm's reach is
// shared among them.
#pragma once

#include "pipeline/hierarchy/drawing_settings.h"
#include "pipeline/hierarchy/execution_settings.h"
#include "pipeline/hierarchy/stacked_model.h"

namespace hbr::inline hierarchy {

struct NumbersSettings {
  int digits = 0;
  double line_spacing = 0;
  PencilSettings pencil;
  std::string way_points = {};
};
template <class Fields>
void describe(Fields& f, NumbersSettings& s) {
  f.number("digits", s.digits, Range{2, 3}, "of a number");
  f.number("line_spacing", s.line_spacing, Range{0, 10},
           "distance between the points of a line at which layer 1 is asked, m; 0: at its end alone");
  describe_way_points(f, s.way_points);
  f.table("pencil", s.pencil, "from trace to image");
}

// Genome: for each digit its command to layer 4 over the range of the descriptor there, then how far it is
// displaced on the paper, by up to L along each axis.
class NumberDecoder final : public Decoder {
 public:
  NumberDecoder(const Frame& frame, int digits, int command_size, float low, float high)
      : frame_(frame), digits_(digits), command_size_(command_size), low_(low), high_(high) {}
  Coordinates genes() const;
  int command_size() const override { return command_size_; }
  int max_commands() const override { return digits_; }
  int decode(const float* genome, int length, double* commands) const override;
  bool places() const override { return true; }
  bool displaces() const override { return true; }
  Eigen::Vector2d displacement(const float* genome, int k) const override;

 private:
  int block() const { return command_size_ + 2; }

  Frame frame_;
  int digits_, command_size_;
  float low_, high_;
};

// How far the digits of an execution reach back over the one before them, in shares of the drawing area's
// side.
float overlap_of_strokes(const Executions& executions, int execution, int digits);

std::unique_ptr<LayerModel> make_numbers(const NumbersSettings& settings, const Surroundings& around);

}  // namespace hbr::inline hierarchy
