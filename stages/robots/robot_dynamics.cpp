// The digits replayed by another robot's servos under gravity: its drawing joints alone, and its whole body.
#include <fmt/ranges.h>

#include <optional>

#include "models/robot/plane/drawing_servos.h"
#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/parallel.h"
#include "pipeline/drawing/draw.h"
#include "pipeline/drawing/image_difference.h"
#include "pipeline/hierarchy/drawing_settings.h"
#include "pipeline/hierarchy/trace.h"
#include "stages/layers/body.h"
#include "stages/layers/read_stack.h"
#include "stages/robots/robot_tasks.h"

namespace hbr {
namespace {

struct DynamicsSlice : RunTable {
  DynamicsTable dynamics;
  RobotSettings robot;
  PencilSettings pencil;
};
template <class Fields>
void describe(Fields& f, DynamicsSlice& s) {
  describe_run(f, s);
  f.table("pencil", s.pencil, "of the digits");
  f.table("dynamics", s.dynamics, "how the digits are replayed");
  f.table("robot", s.robot, "the robot");
}

// Images [n x 28 x 28], and how they differ from those before.
struct Drawn {
  std::vector<std::uint8_t> image;
  std::vector<float> absolute, squared;

  explicit Drawn(std::size_t n) : image(n * kImagePixels), absolute(n), squared(n) {}
  void set(std::size_t i, const Eigen::VectorXf& drawn, const Eigen::VectorXf& before) {
    image_to_bytes(drawn.data(), &image[i * kImagePixels]);
    const ImageDifference difference = image_difference(drawn, before);
    absolute[i] = difference.absolute;
    squared[i] = difference.squared;
  }
  void write(Hdf5Writer& file, const std::string& group) const {
    file.write(group + "/image", {absolute.size(), kImageSide, kImageSide}, image.data());
    file.write(group + "/absolute", absolute);
    file.write(group + "/squared", squared);
  }
};

// A body that replays the digits, and what it came to.
struct Player {
  std::string name;
  DrawingServos servos;
  Drawn drawn;
  std::vector<float> rms, worst, off_plane;  // [n] m
  std::vector<float> torque, speed;          // [n x dof] shares of the limits
  std::vector<float> faster;                 // [n]
  std::vector<std::int32_t> limit_joint;     // [n]
  std::vector<std::uint8_t> by_torque;       // [n]

  Player(std::string player, std::shared_ptr<const Body> body, const RobotSettings& robot, std::size_t n)
      : name(std::move(player)),
        servos(std::move(body), robot),
        drawn(n),
        rms(n),
        worst(n),
        off_plane(n),
        torque(n * dof()),
        speed(torque.size()),
        faster(n),
        limit_joint(n),
        by_torque(n) {}

  std::size_t dof() const { return static_cast<std::size_t>(servos.body().dof()); }

  void set(std::size_t i, const Replay& replay, const Fastest& fastest, const DrawingPlane& plane) {
    const ReplayErrors errors = replay_errors(replay, plane);
    rms[i] = static_cast<float>(errors.rms);
    worst[i] = static_cast<float>(errors.worst);
    off_plane[i] = static_cast<float>(errors.off_plane);
    for (std::size_t k = 0; k < dof(); ++k) {
      torque[i * dof() + k] = static_cast<float>(replay.torque[static_cast<Eigen::Index>(k)]);
      speed[i * dof() + k] = static_cast<float>(replay.speed[static_cast<Eigen::Index>(k)]);
    }
    faster[i] = static_cast<float>(fastest.factor);
    limit_joint[i] = fastest.joint;
    by_torque[i] = fastest.by_torque;
  }

  void write(Hdf5Writer& file) const {
    drawn.write(file, name);
    file.write(name + "/rms", rms);
    file.write(name + "/max", worst);
    file.write(name + "/off_plane", off_plane);
    const std::vector<std::size_t> shape{rms.size(), dof()};
    file.write(name + "/torque", shape, torque.data());
    file.write(name + "/speed", shape, speed.data());
    file.write(name + "/faster", faster);
    file.write(name + "/limit_joint", limit_joint);
    file.write(name + "/by_torque", by_torque);
    file.attribute(name + ".joints", fmt::format("{}", fmt::join(servos.body().moving(), " ")));
  }
};

void run(StageRun& stage) {
  const auto s = stage.settings_as<DynamicsSlice>();
  const StackOnBody stack = read_stack(stage, "robot");
  const RobotOnPlane& robot = on_plane(*stack.body);
  const LayerModel& model = stack.top();
  const Elites& digits = stack.elites.back();
  const ServoSettings servos{s.dynamics.step, s.dynamics.control_every, s.dynamics.drawing_hz,
                             s.dynamics.holding_hz};

  std::vector<Eigen::Index> replayed;
  for (Eigen::Index i = 0; i < digits.size(); i += s.dynamics.every) replayed.push_back(i);
  const std::size_t n = replayed.size();
  std::vector<std::int64_t> id(n);
  std::vector<float> duration(n);
  std::vector<std::uint8_t> before_images(n * kImagePixels);
  Drawn wanted_images(n);
  Player arm("arm", std::make_shared<const Body>(robot.body().model(), s.robot.joints, s.robot.rest()),
             s.robot, n);
  std::vector<Player*> players{&arm};
  std::optional<Player> whole;
  if (auto body = whole_body(robot.body().model(), s.robot, s.dynamics.lightest)) {
    whole.emplace("whole", std::move(body), s.robot, n);
    players.push_back(&*whole);
  }

  // The tip's way as the pencil sees it.
  const auto draw_tip = [&](const std::vector<Eigen::Vector3d>& tip, double width, Eigen::VectorXf& image) {
    draw(pen_of(tip, robot.plane()).data(), static_cast<Eigen::Index>(tip.size()), width,
         framing_named(s.pencil.framing), stack.stack.frame().half_side, image.data());
  };

  Workers workers(stage.threads());
  workers.for_ranges(n, 1, [&](std::size_t begin, std::size_t end) {
    Eigen::VectorXf before(kImagePixels), after(kImagePixels);
    for (std::size_t i = begin; i < end; ++i) {
      const float* genome = digits.solution.row(replayed[i]).data();
      const int length = digits.genes(replayed[i]);
      const Trace trace = trace_of(*model.executor(), genome, length);
      const JointPath movement(trace.joints,
                               times_at_pace(trace.pen, trace.joints, s.dynamics.pace, s.dynamics.joint_pace),
                               s.dynamics.smoothing);
      id[i] = digits.id[static_cast<std::size_t>(replayed[i])];
      duration[i] = static_cast<float>(movement.duration());
      model.draw(genome, length, before.data());
      image_to_bytes(before.data(), &before_images[i * kImagePixels]);
      for (Player* player : players) {
        const Replay played = player->servos.replay(robot.tip(), movement, servos);
        player->set(i, played, player->servos.fastest(movement, servos.step * servos.control_every),
                    robot.plane());
        draw_tip(played.tip, s.pencil.width(genome[2]), after);
        player->drawn.set(i, after, before);
        if (player != &arm) continue;
        draw_tip(played.wanted, s.pencil.width(genome[2]), after);
        wanted_images.set(i, after, before);
      }
    }
  });

  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  file.write("id", id);
  file.write("duration", duration);
  file.write("image", {n, kImageSide, kImageSide}, before_images.data());
  wanted_images.write(file, "wanted");
  for (const Player* player : players) player->write(file);
  file.close();
}

}  // namespace
}  // namespace hbr

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "The digits replayed by a robot's servos", hbr::run);
}
