// Transfer (paper, section 5.2): every line, arc and digit executed by the arm and by another robot through
// the same layers 2 to 4.
#include <algorithm>
#include <cmath>

#include "models/simbody/plane_file.h"
#include "models/simbody/robot_on_plane.h"
#include "pipeline/core/parallel.h"
#include "stages/evolve.h"
#include "stages/layer_errors.h"
#include "stages/robot_tasks.h"

namespace {

struct TransferSlice : hbr::DigitsSlice {
  hbr::ArcReadingTable reading;
  hbr::TransferTable transfer;
  hbr::RobotSettings robot;
};
template <class Fields>
void describe(Fields& f, TransferSlice& s) {
  describe_digits(f, s);
  f.table("reading", s.reading, "of an arc's descriptor");
  f.table("transfer", s.transfer, "lines and arcs");
  f.table("robot", s.robot, "the robot");
}

// The digit that a picture shows: of those that the judge calls good, plain 0s and 1s aside, the one it is
// surest of.
Eigen::Index most_legible(const hbr::Hdf5Reader& digits) {
  const auto label = digits.read<std::uint8_t>("hbr/label").values;
  const auto good = digits.read<std::uint8_t>("hbr/good").values;
  const auto confidence = digits.read<float>("hbr/confidence").values;
  std::size_t best = 0;
  const auto rank = [&](std::size_t i) { return std::pair(good[i] && label[i] > 1, confidence[i]); };
  for (std::size_t i = 1; i < label.size(); ++i)
    if (rank(i) > rank(best)) best = i;
  return static_cast<Eigen::Index>(best);
}

// Of all lines and arcs that the repertoires hold.
void write_layer_errors(hbr::Hdf5Writer& file, const hbr::StageRun& stage, const TransferSlice& s,
                        const hbr::PointLayer& arm, const hbr::PointLayer& robot, const hbr::LineLayer& lines,
                        const hbr::ArcLayer& arcs, hbr::Workers& workers) {
  const hbr::Seed seed = hbr::Seed(s.seed).child(stage.stage()).child(s.replication);
  const auto starts = static_cast<std::size_t>(s.transfer.starts);

  const hbr::Rows of_lines = hbr::read_elites(stage.input("layer2")).measures,
                  of_arcs = hbr::read_elites(stage.input("layer3")).measures;
  const hbr::LineErrors line = line_errors(arm, robot, line_tasks(arm.frame(), of_lines, lines, lines),
                                           s.transfer.starts, seed.child("lines"), workers);
  const auto n_lines = static_cast<std::size_t>(of_lines.rows());
  file.write("lines/end", {n_lines, starts}, line.end.data());
  file.write("lines/displacement", {n_lines, starts}, line.displacement.data());

  const hbr::Strokes strokes{lines, arcs};
  const hbr::ArcErrors arc =
      arc_errors(arm, robot, arc_tasks(arm.frame(), of_arcs, strokes, strokes),
                 hbr::make_reading(s.reading).centre, s.transfer.starts, seed.child("arcs"), workers);
  const auto n_arcs = static_cast<std::size_t>(of_arcs.rows());
  file.write("arcs/end", {n_arcs, starts}, arc.end.data());
  file.write("arcs/centre", {n_arcs, starts}, arc.centre.data());
  file.write("arcs/length", {n_arcs, starts}, arc.length.data());
}

void run(hbr::StageRun& stage) {
  const auto s = stage.settings_as<TransferSlice>();
  const hbr::Frame frame = hbr::make_frame(s);
  const hbr::PlanarArm arm = hbr::make_arm(s.arm);
  const hbr::RobotOnPlane robot = hbr::make_robot(s.robot, hbr::load_plane(stage.input("plane")));
  const hbr::PointLayer arm_points = hbr::read_points(stage, "layer1", arm, frame);
  const hbr::PointLayer robot_points = hbr::read_points(stage, "robot_layer1", robot, frame);
  const hbr::LineLayer lines = hbr::read_lines(stage, "layer2", frame);
  const hbr::ArcLayer arcs = hbr::read_arcs(stage, "layer3", frame, s.controller);
  const hbr::Hierarchy by_arm(arm_points, lines, arcs, frame, s.line_spacing,
                              hbr::out_of_range(s.out_of_range));
  const hbr::Hierarchy by_robot(robot_points, lines, arcs, frame, s.line_spacing,
                                hbr::out_of_range(s.out_of_range));
  const hbr::Pencil pencil = hbr::make_pencil(s.pencil);
  const hbr::Elites digits = hbr::read_elites(stage.input("layer4"));

  const auto n = static_cast<std::size_t>(digits.size());
  std::vector<std::uint8_t> arm_images(n * hbr::kImagePixels), robot_images(n * hbr::kImagePixels);
  std::vector<float> absolute(n), squared(n);
  hbr::Workers workers(stage.threads());
  workers.for_ranges(n, 16, [&](std::size_t begin, std::size_t end) {
    Eigen::VectorXf a(hbr::kImagePixels), b(hbr::kImagePixels);
    for (std::size_t i = begin; i < end; ++i) {
      const float* genome = digits.solution.row(i).data();
      const int length = digits.genes(i);
      hbr::draw_digit(by_arm, pencil, genome, length, a.data());
      hbr::draw_digit(by_robot, pencil, genome, length, b.data());
      absolute[i] = (a - b).cwiseAbs().mean();
      squared[i] = (a - b).squaredNorm() / static_cast<float>(hbr::kImagePixels);
      hbr::image_to_bytes(a.data(), &arm_images[i * hbr::kImagePixels]);
      hbr::image_to_bytes(b.data(), &robot_images[i * hbr::kImagePixels]);
    }
  });

  const Eigen::Index shown = most_legible(hbr::Hdf5Reader(stage.input("digits")));
  std::vector<std::int32_t> path;
  by_robot.digit_path(digits.solution.row(shown).data(), digits.genes(shown), path);
  const hbr::Trace trace = by_robot.trace(path);
  const auto points = static_cast<std::size_t>(trace.points());

  const std::vector<std::size_t> images{n, hbr::kImageSide, hbr::kImageSide};
  hbr::Hdf5Writer file(stage.output());
  stage.write_settings(file);
  file.attribute("framing", s.pencil.framing);
  file.write("id", digits.id);
  file.write("arm", images, arm_images.data());
  file.write("robot", images, robot_images.data());
  file.write("absolute", absolute);
  file.write("squared", squared);
  write_layer_errors(file, stage, s, arm_points, robot_points, lines, arcs, workers);
  file.write("picture/pen", {points, 2}, trace.pen.data());
  file.write("picture/joints", {points, static_cast<std::size_t>(robot.dof())},
             std::vector<float>(trace.joints.begin(), trace.joints.end()).data());
  file.write("picture/id", std::vector<std::int64_t>{digits.id[shown]});
  file.close();
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Transfer of the digits", run); }
