// How a robot draws each digit: the postures along it. Each place is held as layer 1 has it, but for the
// digits that the judge is surest of: along these the joints turn as little as they can.
#include "models/judge/surest.h"
#include "models/robot/plane/posture_path.h"
#include "pipeline/core/parallel.h"
#include "pipeline/hierarchy/trace.h"
#include "stages/layers/body.h"
#include "stages/layers/read_stack.h"

namespace hbr::inline stages {
namespace {

// The rows of digits that get a way of their own.
std::vector<std::size_t> surest(const StageRun& stage, std::size_t n) {
  const Hdf5Reader judged(stage.input("digits"));
  const JudgedDigits said{judged.read<std::uint8_t>("hbr/label").values,
                          judged.read<std::uint8_t>("hbr/good").values,
                          judged.read<float>("hbr/confidence").values};
  if (said.label.size() != n || said.good.size() != n || said.confidence.size() != n)
    throw InputError("{}: judges {} digits; expected the {} of {}; make it again", judged.path().string(),
                     said.label.size(), n, stage.name());
  return surest_of_each_class(said);
}

// Postures, each once, and the ways through them.
class Ways {
 public:
  Ways(std::size_t digits, const PointLayer& points)
      : ways_(digits), smooth_(digits), points_(points), row_(points.size(), -1) {}

  void along_elites(std::size_t digit, const std::vector<std::int32_t>& elites) {
    for (const std::int32_t elite : elites) {
      if (row_[elite] < 0) {
        const Eigen::Vector2d p = points_.position(elite);
        row_[elite] = add(points_.joints(elite), p);
      }
      ways_[digit].push_back(row_[elite]);
    }
  }
  void along(std::size_t digit, const std::vector<double>& joints, const Robot& robot) {
    smooth_[digit] = 1;
    const Eigen::Index n = static_cast<Eigen::Index>(joints.size()) / robot.dof();
    std::vector<Pen> pens(n);
    robot.pens(n, joints.data(), pens.data());
    for (Eigen::Index k = 0; k < n; ++k)
      ways_[digit].push_back(add(&joints[k * robot.dof()], pens[k].position));
  }
  void write(Hdf5Writer& file) const {
    std::vector<std::int32_t> count, way;
    for (const std::vector<std::int32_t>& of : ways_) {
      count.push_back(static_cast<std::int32_t>(of.size()));
      way.insert(way.end(), of.begin(), of.end());
    }
    const std::size_t rows = pen_.size() / 2;
    file.write("points", count);
    file.write("smooth", smooth_);
    file.write("way", way);
    file.write("joints", {rows, rows ? joints_.size() / rows : 0}, joints_.data());
    file.write("pen", {rows, 2}, pen_.data());
  }

 private:
  std::int32_t add(const double* joints, const Eigen::Vector2d& p) {
    joints_.insert(joints_.end(), joints, joints + points_.dof());
    pen_.insert(pen_.end(), {static_cast<float>(p.x()), static_cast<float>(p.y())});
    return static_cast<std::int32_t>(pen_.size() / 2) - 1;
  }

  std::vector<std::vector<std::int32_t>> ways_;
  std::vector<std::uint8_t> smooth_;
  const PointLayer& points_;
  std::vector<std::int32_t> row_;  // of each elite; -1 where no way leads through it
  std::vector<float> joints_, pen_;
};

void run(StageRun& stage) {
  const StackOnBody stack = read_stack(stage, "layer");
  const Executor& executor = *stack.top().executor();
  const Elites& digits = stack.elites.back();
  const auto n = static_cast<std::size_t>(digits.size());

  const RobotOnPlane& robot = on_plane(*stack.body);
  const std::vector<std::size_t> chosen = surest(stage, n);
  std::vector<std::vector<double>> shortest(n);
  Workers workers(stage.threads());
  workers.for_each(chosen.size(), [&](std::size_t k) {
    const auto row = static_cast<Eigen::Index>(chosen[k]);
    const Trace trace = trace_of(executor, digits.solution.row(row).data(), digits.genes(row));
    shortest[chosen[k]] = least_travel(robot, stack.stack.points(), trace);
  });
  Ways ways(n, stack.stack.points());
  for (std::size_t i = 0; i < n; ++i) {
    if (!shortest[i].empty()) {
      ways.along(i, shortest[i], robot);
      continue;
    }
    const auto row = static_cast<Eigen::Index>(i);
    ways.along_elites(i, way_of(executor, digits.solution.row(row).data(), digits.genes(row)));
  }

  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  file.write("id", digits.id);
  ways.write(file);
  file.close();
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "The postures along each digit", hbr::run);
}
