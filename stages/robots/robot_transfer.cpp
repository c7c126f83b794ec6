// Transfer (paper, section 5.2): every line, arc and digit executed by the arm and by another robot through
// the same layers 2 to 4; the digits also over the robot's layer 1 as it was evolved, before it was moved
// onto the plane and completed.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "models/judge/judge.h"
#include "models/judge/surest.h"
#include "models/robot/plane/lost_places.h"
#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/parallel.h"
#include "pipeline/drawing/image_difference.h"
#include "pipeline/hierarchy/drawing_settings.h"
#include "pipeline/hierarchy/layers/arcs.h"
#include "pipeline/hierarchy/trace.h"
#include "stages/layers/body.h"
#include "stages/layers/read_stack.h"
#include "stages/robots/robot_tasks.h"
#include "stages/studies/layer_errors.h"

namespace {

struct TransferSlice : hbr::RunTable {
  hbr::TransferTable transfer;
  hbr::PencilSettings pencil;
  double spacing = 0;
};
template <class Fields>
void describe(Fields& f, TransferSlice& s) {
  describe_run(f, s);
  f.table("transfer", s.transfer, "lines and arcs");
  f.table("pencil", s.pencil, "of the digits");
  f.number("spacing", s.spacing, hbr::Range{1e-4, 10}, "l: of the robot's layer 1, descriptor units");
}

constexpr std::size_t kWorst = 8;     // digits of each form that are explained
constexpr int kReachSamples = 20000;  // starts for inverse kinematics

// Digits drawn by a robot, and how they differ from the arm's.
struct Drawn {
  std::vector<std::uint8_t> images;  // [n x 28 x 28]
  std::vector<float> absolute, squared;

  explicit Drawn(std::size_t n) : images(n * hbr::kImagePixels), absolute(n), squared(n) {}
  void set(std::size_t i, const Eigen::VectorXf& arm, const Eigen::VectorXf& robot) {
    const hbr::ImageDifference difference = hbr::image_difference(arm, robot);
    absolute[i] = difference.absolute;
    squared[i] = difference.squared;
    hbr::image_to_bytes(robot.data(), &images[i * hbr::kImagePixels]);
  }
  void write(hbr::Hdf5Writer& file, const std::string& group) const {
    file.write(group + "robot", {absolute.size(), hbr::kImageSide, hbr::kImageSide}, images.data());
    file.write(group + "absolute", absolute);
    file.write(group + "squared", squared);
  }
};

// The digits that differ most from the arm's, and what the places lack that the arm draws them through.
void write_worst(hbr::Hdf5Writer& file, const std::string& group, const Drawn& drawn,
                 const hbr::StackOnBody& arm, const hbr::StackOnBody& robot, const hbr::Reach& reach,
                 double spacing, hbr::Workers& workers) {
  const hbr::Elites& digits = arm.elites.back();
  const hbr::PointLayer& points = robot.stack.points();
  std::vector<Eigen::Index> order(drawn.absolute.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, std::greater<>(), [&](Eigen::Index i) { return drawn.absolute[i]; });
  order.resize(std::min(kWorst, order.size()));
  const std::size_t n = order.size();
  std::vector<std::int64_t> id(n);
  std::vector<std::int32_t> places(n), gap(n), collision(n), limit(n);
  std::vector<float> apart(n);
  workers.for_ranges(n, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Index row = order[i];
      id[i] = digits.id[row];
      const auto drawn_by = [&](const hbr::StackOnBody& stack) {
        return trace_of(*stack.top().executor(), digits.solution.row(row).data(), digits.genes(row));
      };
      const hbr::Trace asked = drawn_by(arm), given = drawn_by(robot);
      std::vector<Eigen::Vector2d> way;
      for (Eigen::Index k = 0; k < asked.points(); ++k)
        way.emplace_back(asked.pen[2 * k], asked.pen[2 * k + 1]);
      for (Eigen::Index k = 0; k < std::min(asked.points(), given.points()); ++k)
        apart[i] = std::max(apart[i], std::hypot(given.pen[2 * k] - asked.pen[2 * k],
                                                 given.pen[2 * k + 1] - asked.pen[2 * k + 1]));
      const hbr::Lacks lacks =
          lacks_along(hbr::on_plane(*robot.body), points, reach, way, spacing * 2 * points.frame().half_side);
      const auto of = [&](hbr::Lack lack) { return lacks[static_cast<std::size_t>(lack)]; };
      places[i] = static_cast<std::int32_t>(way.size());
      gap[i] = of(hbr::Lack::gap);
      collision[i] = of(hbr::Lack::collision);
      limit[i] = of(hbr::Lack::limit);
    }
  });
  file.write(group + "worst/id", id);
  file.write(group + "worst/places", places);
  file.write(group + "worst/apart", apart);
  file.write(group + "worst/gap", gap);
  file.write(group + "worst/collision", collision);
  file.write(group + "worst/limit", limit);
}

// Of all lines and arcs that the repertoires hold.
void write_layer_errors(hbr::Hdf5Writer& file, const TransferSlice& s, hbr::Seed seed,
                        const hbr::StackOnBody& arm, const hbr::StackOnBody& robot, hbr::Workers& workers) {
  const auto starts = static_cast<std::size_t>(s.transfer.starts);
  const auto sides = [&](int level) {
    return std::pair(hbr::Side{arm.stack.points(), arm.stack.layer(level)},
                     hbr::Side{robot.stack.points(), robot.stack.layer(level)});
  };
  const int lines = arm.level("lines"), arcs = arm.level("arcs");
  file.write("lines/id", arm.elites[lines].id);
  file.write("arcs/id", arm.elites[arcs].id);
  const hbr::Rows &of_lines = arm.elites[lines].measures, &of_arcs = arm.elites[arcs].measures;

  const auto [arm_lines, robot_lines] = sides(lines);
  const hbr::LineErrors line = line_errors(arm.stack.model(lines).frame(), of_lines, arm_lines, robot_lines,
                                           s.transfer.starts, seed.child("lines"), workers);
  const auto n_lines = static_cast<std::size_t>(of_lines.rows());
  file.write("lines/end", {n_lines, starts}, line.end.data());
  file.write("lines/displacement", {n_lines, starts}, line.displacement.data());

  const auto [arm_arcs, robot_arcs] = sides(arcs);
  const hbr::ArcErrors arc = arc_errors(arm.stack.model(arcs), of_arcs, arm_arcs, robot_arcs,
                                        s.transfer.starts, seed.child("arcs"), workers);
  const auto n_arcs = static_cast<std::size_t>(of_arcs.rows());
  file.write("arcs/end", {n_arcs, starts}, arc.end.data());
  file.write("arcs/centre", {n_arcs, starts}, arc.centre.data());
  file.write("arcs/length", {n_arcs, starts}, arc.length.data());
}

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<TransferSlice>();
  const hbr::StackOnBody arm = hbr::read_stack(stage, "arm"), robot = hbr::read_stack(stage, "robot"),
                         evolved = hbr::read_stack(stage, "evolved");
  const hbr::LayerModel &by_arm = arm.top(), &by_robot = robot.top(), &by_evolved = evolved.top();
  const hbr::Elites& digits = arm.elites.back();

  const auto n = static_cast<std::size_t>(digits.size());
  std::vector<std::uint8_t> arm_images(n * hbr::kImagePixels);
  Drawn completed(n), as_evolved(n);
  hbr::Workers workers(stage.threads());
  workers.for_ranges(n, 16, [&](std::size_t begin, std::size_t end) {
    Eigen::VectorXf a(hbr::kImagePixels), b(hbr::kImagePixels);
    for (std::size_t i = begin; i < end; ++i) {
      const float* genome = digits.solution.row(i).data();
      const int length = digits.genes(i);
      by_arm.draw(genome, length, a.data());
      hbr::image_to_bytes(a.data(), &arm_images[i * hbr::kImagePixels]);
      by_robot.draw(genome, length, b.data());
      completed.set(i, a, b);
      by_evolved.draw(genome, length, b.data());
      as_evolved.set(i, a, b);
    }
  });

  const hbr::Hdf5Reader judged(stage.input("digits"));
  hbr::Verdicts of_arm;
  of_arm.label = judged.read<std::uint8_t>("hbr/label").values;
  of_arm.good = judged.read<std::uint8_t>("hbr/good").values;
  const auto shown = static_cast<Eigen::Index>(
      hbr::most_legible({of_arm.label, of_arm.good, judged.read<float>("hbr/confidence").values}));
  const hbr::Trace trace =
      trace_of(*by_robot.executor(), digits.solution.row(shown).data(), digits.genes(shown));
  const auto points = static_cast<std::size_t>(trace.points());

  hbr::Hdf5Writer file(stage.output());
  stage.write_settings(file);
  file.attribute("framing", s.pencil.framing);
  file.write("id", digits.id);
  file.write("arm", {n, hbr::kImageSide, hbr::kImageSide}, arm_images.data());
  const hbr::Dataset dataset = hbr::read_dataset(stage.input("dataset"));
  const hbr::Judge judge(hbr::Hdf5Reader(stage.input("judge")), dataset, workers);
  file.write("good", of_arm.good);
  const hbr::RobotOnPlane& body = hbr::on_plane(*robot.body);
  const hbr::Reach reach(body.body(), body.tip(), body.clearance(), kReachSamples, 0,
                         seed_of(stage, s).child("reach"));
  write_worst(file, "", completed, arm, robot, reach, s.spacing, workers);
  write_worst(file, "evolved/", as_evolved, arm, evolved, reach, s.spacing, workers);
  for (const auto& [drawn, group] : {std::pair{&completed, ""}, std::pair{&as_evolved, "evolved/"}}) {
    drawn->write(file, group);
    file.write(std::string(group) + "lost",
               hbr::lost_digits(of_arm, judge.judge(n, drawn->images.data(), workers)));
  }
  write_layer_errors(file, s, seed_of(stage, s), arm, robot, workers);
  file.write("picture/pen", {points, 2}, trace.pen.data());
  file.write("picture/joints", {points, static_cast<std::size_t>(robot.body->dof())},
             std::vector<float>(trace.joints.begin(), trace.joints.end()).data());
  file.write("picture/id", std::vector<std::int64_t>{digits.id[shown]});
  file.close();
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Transfer of the digits", run); }
