// Layer 2, lines (paper, section 4.3): displacements of the pen. A genome asks layer 1 for a displacement;
// the descriptor is the one that is drawn.
#pragma once

#include "pipeline/hierarchy/drawing_settings.h"
#include "pipeline/hierarchy/execution_settings.h"
#include "pipeline/hierarchy/stacked_model.h"

namespace hbr::inline hierarchy {

// Which displacements lines ask for.
struct LinesFromStartSettings {
  double longest_line = 0;
  std::string line_range;
  StartSettings start = {};
};
template <class Fields>
void describe(Fields& f, LinesFromStartSettings& s) {
  describe_longest_line(f, s.longest_line);
  f.choice("line_range", s.line_range, {"disc", "square"}, "of radius rho, or of side 2 rho");
  describe_starts(f, s.start);
}
struct LinesSettings : LinesFromStartSettings {
  int samples = 0;
};
template <class Fields>
void describe(Fields& f, LinesSettings& s) {
  describe(f, static_cast<LinesFromStartSettings&>(s));
  describe_samples(f, s.samples);
}

// Two genes in [0, 1] -> a displacement [m] within the square of side 2 rho; in the disc of radius rho its
// corners are brought back along their direction.
Eigen::Vector2d decode_line(const Frame& frame, const float* genes);

// Both genes, and both coordinates of the descriptor.
Coordinates line_coordinates(const Frame& frame);

class LineDecoder final : public Decoder {
 public:
  explicit LineDecoder(const Frame& frame) : frame_(frame) {}
  int command_size() const override { return 2; }
  int max_commands() const override { return 1; }
  bool relative() const override { return true; }
  int decode(const float* genome, int length, double* commands) const override;

 private:
  Frame frame_;
};

// Displacement V from the first stop to the second: descriptor V / 2 rho + 1/2. Fitness 0.
class LineOutcome final : public SampledOutcome {
 public:
  explicit LineOutcome(const Frame& frame)
      : scale_(static_cast<float>(frame.half_side / frame.longest_line)) {}
  int descriptor_size() const override { return 2; }
  void describe(const Executions& executions, int first, int n, float* const* descriptor) const override;
  double fitness(const Executions&, int) const override { return 0; }

 private:
  float scale_;
};

// The reference without a stochastic descriptor (paper, section 5.3): (P0, V), P0 as in layer 1, V as above.
class LineFromStartOutcome final : public SampledOutcome {
 public:
  explicit LineFromStartOutcome(const Frame& frame) : line_(frame) {}
  int descriptor_size() const override { return 4; }
  void describe(const Executions& executions, int first, int n, float* const* descriptor) const override;
  double fitness(const Executions&, int) const override { return 0; }

 private:
  LineOutcome line_;
};

std::unique_ptr<LayerModel> make_lines(const LinesSettings& settings, const Surroundings& around);
std::unique_ptr<LayerModel> make_lines_from_start(const LinesFromStartSettings& settings,
                                                  const Surroundings& around);

}  // namespace hbr::inline hierarchy
