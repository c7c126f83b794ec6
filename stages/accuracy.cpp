// How well layer 2 draws the lines it is asked for (paper, section 5.3): every contender gets the same
// requests from the same starts.
#include <cmath>
#include <numbers>

#include "pipeline/core/parallel.h"
#include "pipeline/qd/neighbour_grid.h"
#include "stages/evolve.h"

namespace {

struct Request {
  Eigen::Vector2d wanted;  // m
  std::int32_t start;      // layer-1 elite
};

std::vector<Request> draw_requests(int n, const hbr::PointLayer& points, const hbr::Frame& frame,
                                   hbr::Rng rng) {
  std::vector<Request> requests(n);
  for (Request& r : requests) {
    const double direction = 2 * std::numbers::pi * rng.uniform_double();
    const double length = frame.longest_line * rng.uniform_double();
    r.wanted = length * Eigen::Vector2d(std::cos(direction), std::sin(direction));
    r.start = static_cast<std::int32_t>(rng.below(static_cast<std::uint32_t>(points.size())));
  }
  return requests;
}

// The reference keeps an elite for a start and a displacement. Replaying it means to go where it ended, or to
// ask for the displacement that it asked for.
class Reference {
 public:
  Reference(const hbr::Elites& elites, const hbr::Frame& frame)
      : elites_(elites), frame_(frame), grid_(0, 1, 0.02f) {
    for (hbr::Slot s = 0; s < elites.size(); ++s) grid_.insert(s, descriptor(s));
  }

  hbr::Slot nearest(const Eigen::Vector2d& from, const Eigen::Vector2d& wanted) const {
    Eigen::Vector4f query;
    query << frame_.point_descriptor(from).cast<float>(), frame_.line_descriptor(wanted).cast<float>();
    Grid::Near near;
    grid_.nearest(query.data(), 1, hbr::kNoSlot, &near);
    return near.slot;
  }
  Eigen::Vector2d end(hbr::Slot s) const {
    const Eigen::Vector4d d = elites_.measures.row(s).transpose().cast<double>();
    return frame_.point(d.head<2>()) + frame_.line(d.tail<2>());
  }
  Eigen::Vector2d request(hbr::Slot s) const {
    return hbr::decode_line(frame_, elites_.solution.row(s).data());
  }

 private:
  using Grid = hbr::NeighbourGrid<4>;
  const float* descriptor(hbr::Slot s) const { return elites_.measures.row(s).data(); }
  const hbr::Elites& elites_;
  hbr::Frame frame_;
  Grid grid_;
};

// Where layer 1 brings the pen when asked for `displacement` from `start`, relative to there.
Eigen::Vector2d drawn(const hbr::PointLayer& points, std::int32_t start,
                      const Eigen::Vector2d& displacement) {
  return points.position(hbr::line_end(points, start, displacement)) - points.position(start);
}

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<hbr::AccuracySlice>();
  const hbr::PlanarArm arm = hbr::make_arm(s.arm);
  const hbr::Frame frame = hbr::make_frame(s);
  const hbr::PointLayer points = hbr::read_points(stage, "layer1", arm, frame);
  const auto requests = draw_requests(s.requests, points, frame,
                                      hbr::Rng(hbr::Seed(s.seed).child(stage.stage()).child(s.replication)));

  hbr::Workers workers(stage.threads());
  hbr::Hdf5Writer file(stage.output());
  stage.write_settings(file);
  const auto judge = [&](const std::string& contender, auto&& answer) {
    std::vector<float> squared_error(requests.size());
    workers.for_ranges(requests.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        squared_error[i] = static_cast<float>((requests[i].wanted - answer(requests[i])).squaredNorm());
    });
    file.write(contender + "/squared_error", squared_error);
  };

  for (const std::string& input : stage.inputs()) {
    if (input == "layer1") continue;
    if (input == "reference4d") {
      const hbr::Elites elites = hbr::read_elites(stage.input(input));
      const Reference reference(elites, frame);
      const auto nearest = [&](const Request& r) {
        return reference.nearest(points.position(r.start), r.wanted);
      };
      judge("reference_endpoint", [&](const Request& r) -> Eigen::Vector2d {
        return points.position(points.nearest(reference.end(nearest(r)))) - points.position(r.start);
      });
      judge("reference_displacement",
            [&](const Request& r) { return drawn(points, r.start, reference.request(nearest(r))); });
    } else {
      const hbr::LineLayer lines = hbr::read_lines(stage, input, frame);
      judge(input, [&](const Request& r) { return drawn(points, r.start, lines.request(r.wanted)); });
    }
  }
  file.close();
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Accuracy of the lines", run); }
