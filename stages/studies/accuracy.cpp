// How well layers of lines draw what they are asked for (paper, section 5.3): every contender gets the same
// requests from the same starts.
#include <cmath>
#include <numbers>

#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/parallel.h"
#include "pipeline/hierarchy/layers/lines.h"
#include "pipeline/qd/neighbour_grid.h"
#include "stages/layers/read_stack.h"

namespace hbr {
namespace {

struct AccuracySlice : RunTable {
  int requests = 0;
};
template <class Fields>
void describe(Fields& f, AccuracySlice& s) {
  describe_run(f, s);
  f.number("requests", s.requests, Range{1, 1e7}, "lines asked for");
}

// Displacements wanted [m], each from an elite of layer 1.
struct Requests {
  std::vector<Eigen::Vector2d> wanted;
  std::vector<std::int32_t> start;
};

Requests draw_requests(int n, const PointLayer& points, double longest_line, Rng rng) {
  Requests requests;
  for (int i = 0; i < n; ++i) {
    const double direction = 2 * std::numbers::pi * rng.uniform_double();
    const double length = longest_line * rng.uniform_double();
    requests.wanted.push_back(length * Eigen::Vector2d(std::cos(direction), std::sin(direction)));
    requests.start.push_back(static_cast<std::int32_t>(rng.below(static_cast<std::uint32_t>(points.size()))));
  }
  return requests;
}

// The reference keeps an elite for a start and a displacement. Replaying it means to go where it ended, or to
// ask for the displacement that it asked for.
class Reference {
 public:
  Reference(const Elites& elites, const Frame& frame) : elites_(elites), frame_(frame), grid_(0, 1, 0.02f) {
    for (Slot s = 0; s < elites.size(); ++s) grid_.insert(s, descriptor(s));
  }

  Slot nearest(const Eigen::Vector2d& from, const Eigen::Vector2d& wanted) const {
    Eigen::Vector4f query;
    query << frame_.point_descriptor(from).cast<float>(), frame_.line_descriptor(wanted).cast<float>();
    Grid::Near near;
    grid_.nearest(query.data(), 1, kNoSlot, &near);
    return near.slot;
  }
  Eigen::Vector2d end(Slot s) const {
    const Eigen::Vector4d d = elites_.measures.row(s).transpose().cast<double>();
    return frame_.point(d.head<2>()) + frame_.line(d.tail<2>());
  }
  Eigen::Vector2d request(Slot s) const { return decode_line(frame_, elites_.solution.row(s).data()); }

 private:
  using Grid = NeighbourGrid<4>;
  const float* descriptor(Slot s) const { return elites_.measures.row(s).data(); }
  const Elites& elites_;
  Frame frame_;
  Grid grid_;
};

// Squared distance between what was wanted and what was drawn, m^2.
std::vector<float> squared_errors(const Requests& requests, const Executions& executions) {
  const PointLayer& points = executions.points();
  std::vector<float> errors;
  for (std::size_t i = 0; i < requests.wanted.size(); ++i) {
    const Eigen::Vector2d drawn =
        points.position(executions.stop(1)[i]) - points.position(executions.stop(0)[i]);
    errors.push_back(static_cast<float>((requests.wanted[i] - drawn).squaredNorm()));
  }
  return errors;
}

// What a layer of lines makes of the requests.
std::vector<float> judge(const Requests& requests, const PointLayer& points, const Frame& frame,
                         const Layer& lines) {
  const auto n = static_cast<int>(requests.wanted.size());
  std::vector<float> command[2];
  for (const Eigen::Vector2d& wanted : requests.wanted) {
    const Eigen::Vector2f descriptor = frame.line_descriptor(wanted).cast<float>();
    for (int d = 0; d < 2; ++d) command[d].push_back(descriptor[d]);
  }
  const float* const commands[2] = {command[0].data(), command[1].data()};
  std::vector<std::int32_t> elites(requests.wanted.size());
  lines.nearest(n, commands, elites.data());
  Executions executions;
  executions.begin(points, n);
  executions.move(executions.all(), requests.start.data());
  lines.perform(executions, executions.all(), elites.data());
  return squared_errors(requests, executions);
}

void judge_reference(const Requests& requests, const PointLayer& points, const Reference& reference,
                     Workers& workers, Hdf5Writer& file) {
  const std::size_t n = requests.wanted.size();
  std::vector<std::int32_t> ends(n);
  std::vector<Eigen::Vector2d> displacements(n);
  std::vector<float> step[2] = {std::vector<float>(n), std::vector<float>(n)};
  std::vector<std::int32_t> which(n);
  workers.for_ranges(n, 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Slot slot = reference.nearest(points.position(requests.start[i]), requests.wanted[i]);
      ends[i] = points.nearest(reference.end(slot));
      displacements[i] = reference.request(slot);
      const Eigen::Vector2f in_units = points.frame().point_step(displacements[i]);
      for (int d = 0; d < 2; ++d) step[d][i] = in_units[d];
      which[i] = static_cast<std::int32_t>(i);
    }
  });
  Executions to_end, displaced;
  for (Executions* executions : {&to_end, &displaced}) {
    executions->begin(points, static_cast<int>(n));
    executions->move(executions->all(), requests.start.data());
  }
  to_end.move(to_end.all(), ends.data());
  displaced.displace(displaced.all(), {displacements.data(), step[0].data(), step[1].data(), 1},
                     which.data());
  file.write("reference_endpoint/squared_error", squared_errors(requests, to_end));
  file.write("reference_displacement/squared_error", squared_errors(requests, displaced));
}

// All inputs but layer 1 are contenders.
void run(StageRun& stage) {
  const auto s = stage.settings_as<AccuracySlice>();
  StackOnBody below = read_stack(stage, "below");
  const PointLayer& points = below.stack.points();
  Workers workers(stage.threads());
  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  for (const std::string& input : stage.inputs()) {
    if (input == "below1") continue;
    const StoredLayer contender = read_layer(stage, input, below);
    const Frame& frame = contender.model->frame();
    const Requests requests = draw_requests(s.requests, points, frame.longest_line, Rng(seed_of(stage, s)));
    if (contender.kind == "lines_from_start")
      judge_reference(requests, points, Reference(contender.elites, frame), workers, file);
    else
      file.write(input + "/squared_error",
                 judge(requests, points, frame, *contender.model->finished(contender.elites)));
  }
  file.close();
}

}  // namespace
}  // namespace hbr

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Accuracy of the lines", hbr::run); }
