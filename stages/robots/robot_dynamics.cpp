// The digits replayed by another robot's servos under gravity: its drawing joints alone, and its whole body.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "models/robot/body/servos.h"
#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/check.h"
#include "pipeline/core/parallel.h"
#include "pipeline/drawing/draw.h"
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
    absolute[i] = (drawn - before).cwiseAbs().mean();
    squared[i] = (drawn - before).squaredNorm() / static_cast<float>(kImagePixels);
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
  std::shared_ptr<const Body> body;
  std::vector<int> drawing;  // its joints that draw, in the order of the path's
  Eigen::VectorXd posture;
  Drawn drawn;
  std::vector<float> rms, worst, off_plane;  // [n] m
  std::vector<float> torque, speed;          // [n x dof] shares of the limits
  std::vector<float> faster;                 // [n]
  std::vector<std::int32_t> limit_joint;     // [n]
  std::vector<std::uint8_t> by_torque;       // [n]

  Player(std::string player, std::shared_ptr<const Body> moved, const RobotSettings& robot, std::size_t n)
      : name(std::move(player)),
        body(std::move(moved)),
        posture(body->posture(robot.rest())),
        drawn(n),
        rms(n),
        worst(n),
        off_plane(n),
        torque(n * static_cast<std::size_t>(body->dof())),
        speed(torque.size()),
        faster(n),
        limit_joint(n),
        by_torque(n) {
    for (const std::string& joint : robot.joints) {
      const auto at = std::find(body->moving().begin(), body->moving().end(), joint);
      if (at == body->moving().end())
        throw InputError("robot '{}': joint '{}' moves less than dynamics.lightest; expected a lower one",
                         robot.name, joint);
      drawing.push_back(static_cast<int>(at - body->moving().begin()));
    }
  }

  void set(std::size_t i, const Replay& replay, const Fastest& fastest, const DrawingPlane& plane) {
    double sum = 0, greatest = 0, off = 0;
    for (std::size_t k = 0; k < replay.tip.size(); ++k) {
      const double error = (replay.tip[k] - replay.wanted[k]).norm();
      sum += error * error;
      greatest = std::max(greatest, error);
      off = std::max(off, std::abs(plane.to_pen(replay.tip[k]).off_plane));
    }
    rms[i] = static_cast<float>(std::sqrt(sum / static_cast<double>(replay.tip.size())));
    worst[i] = static_cast<float>(greatest);
    off_plane[i] = static_cast<float>(off);
    const auto dof = static_cast<std::size_t>(body->dof());
    for (std::size_t k = 0; k < dof; ++k) {
      torque[i * dof + k] = static_cast<float>(replay.torque[static_cast<Eigen::Index>(k)]);
      speed[i * dof + k] = static_cast<float>(replay.speed[static_cast<Eigen::Index>(k)]);
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
    const std::vector<std::size_t> shape{rms.size(), static_cast<std::size_t>(body->dof())};
    file.write(name + "/torque", shape, torque.data());
    file.write(name + "/speed", shape, speed.data());
    file.write(name + "/faster", faster);
    file.write(name + "/limit_joint", limit_joint);
    file.write(name + "/by_torque", by_torque);
    file.attribute(name + ".joints", fmt::format("{}", fmt::join(body->moving(), " ")));
  }
};

// All joints but the lightest; none where those that draw are all that there is.
std::shared_ptr<const Body> whole_body(const RobotModel& model, const RobotSettings& robot, double lightest) {
  const std::vector<std::string> joints = joints_with_inertia(model, robot.rest(), lightest);
  if (joints.size() == robot.joints.size() && robot.stands_on.empty()) return nullptr;
  return std::make_shared<const Body>(model, joints, robot.rest(), robot.stands_on);
}

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
    std::vector<float> pen;
    for (const Eigen::Vector3d& p : tip) {
      const Eigen::Vector2f at = robot.plane().to_pen(p).position.cast<float>();
      pen.insert(pen.end(), {at.x(), at.y()});
    }
    draw(pen.data(), static_cast<Eigen::Index>(tip.size()), width, framing_named(s.pencil.framing),
         stack.stack.frame().half_side, image.data());
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
        const Replay played =
            replay(*player->body, robot.tip(), movement, player->drawing, player->posture, servos);
        player->set(i, played,
                    fastest(*player->body, movement, player->drawing, player->posture,
                            servos.step * servos.control_every),
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
