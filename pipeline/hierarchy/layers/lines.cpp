#include "pipeline/hierarchy/layers/lines.h"

#include "pipeline/hierarchy/stack.h"

namespace hbr::inline hierarchy {

Eigen::Vector2d decode_line(const Frame& frame, const float* genes) {
  const Eigen::Vector2d line = frame.line(Eigen::Vector2d(genes[0], genes[1]));
  return frame.line_range == LineRange::kDisc ? at_most(line, frame.longest_line) : line;
}

Coordinates line_coordinates(const Frame& frame) {
  return plane_coordinates("displacement", frame.longest_line);
}

int LineDecoder::decode(const float* genome, int /*length*/, double* commands) const {
  const Eigen::Vector2d displacement = decode_line(frame_, genome);
  commands[0] = displacement.x();
  commands[1] = displacement.y();
  return 1;
}

void LineOutcome::describe(const Executions& executions, int first, int n, float* const* descriptor) const {
  const PointLayer& points = executions.points();
  const std::int32_t *start = executions.stop(0) + first, *stop = executions.stop(1) + first;
  const float scale = scale_;
  float *const x = descriptor[0], *const y = descriptor[1];
  for (int i = 0; i < n; ++i) {
    const float *from = points.descriptor(start[i]), *to = points.descriptor(stop[i]);
    x[i] = (to[0] - from[0]) * scale + 0.5f;
    y[i] = (to[1] - from[1]) * scale + 0.5f;
  }
}

void LineFromStartOutcome::describe(const Executions& executions, int first, int n,
                                    float* const* descriptor) const {
  for (int i = 0; i < n; ++i) {
    const float* from = executions.points().descriptor(executions.stop(0)[first + i]);
    for (int d = 0; d < 2; ++d) descriptor[d][i] = from[d];
  }
  line_.describe(executions, first, n, descriptor + 2);
}

namespace {

StackedParts parts(const LinesFromStartSettings& settings, const Surroundings& around) {
  StackedParts parts;
  parts.frame = around.below->frame();
  parts.frame.longest_line = settings.longest_line;
  parts.genome = {line_coordinates(parts.frame)};
  parts.fitness = {"0 for every line", ""};
  parts.frame.line_range = settings.line_range == "square" ? LineRange::kSquare : LineRange::kDisc;
  parts.decoder = std::make_unique<LineDecoder>(parts.frame);
  parts.starts = settings.start.of(around.robot);
  parts.slack = 0.25f;  // corners of the square that commands may come from
  return parts;
}

}  // namespace

std::unique_ptr<LayerModel> make_lines(const LinesSettings& settings, const Surroundings& around) {
  StackedParts lines = parts(settings, around);
  lines.descriptor = line_coordinates(lines.frame);
  lines.sampled = std::make_unique<LineOutcome>(lines.frame);
  lines.samples = settings.samples;
  return stacked_model(around, std::move(lines));
}

std::unique_ptr<LayerModel> make_lines_from_start(const LinesFromStartSettings& settings,
                                                  const Surroundings& around) {
  StackedParts lines = parts(settings, around);
  lines.descriptor = plane_coordinates("start", lines.frame.half_side);
  append(lines.descriptor, "", line_coordinates(lines.frame));
  lines.outcome = std::make_unique<LineFromStartOutcome>(lines.frame);
  return stacked_model(around, std::move(lines));
}

}  // namespace hbr::inline hierarchy
