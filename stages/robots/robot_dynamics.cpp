// The digits replayed by another robot's servos under gravity: its drawing joints alone, and its whole body.
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "models/judge/judge.h"
#include "models/robot/looks/standing.h"
#include "models/robot/plane/drawing_servos.h"
#include "models/robot/plane/posture_path.h"
#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/parallel.h"
#include "pipeline/drawing/draw.h"
#include "pipeline/drawing/image_difference.h"
#include "pipeline/hierarchy/drawing_settings.h"
#include "pipeline/hierarchy/trace.h"
#include "stages/layers/body.h"
#include "stages/layers/read_stack.h"
#include "stages/robots/robot_links.h"
#include "stages/robots/robot_tasks.h"

namespace hbr::inline stages {
namespace {

constexpr double kTouching = 1e-3;  // m above the lowest place: it touches the floor
constexpr double kFarOutside = 1;   // m outside the sole, at most: where the ground would have to pull
constexpr double kNoGrip = 100;     // likewise
constexpr double kMostSteps = 1e7;  // of the integration, and points of the spline, of one digit

struct DynamicsSlice : RunTable {
  DynamicsTable dynamics;
  RobotSettings robot;
  std::vector<GearSettings> gears;
  PencilSettings pencil;
};
template <class Fields>
void describe(Fields& f, DynamicsSlice& s) {
  describe_run(f, s);
  f.table("pencil", s.pencil, "of the digits");
  f.table("dynamics", s.dynamics, "how the digits are replayed");
  f.table("robot", s.robot, "the robot");
  f.tables("gears", s.gears, "friction and play of its joints");
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
  std::vector<std::uint8_t> off_board;       // [n] 1: farther from the plane than a pen that draws
  std::vector<std::uint8_t> beyond_limit;    // [n] 1: more torque or speed was asked for than there is
  std::vector<std::int32_t> limit_joint;     // [n]
  std::vector<std::uint8_t> by_torque;       // [n]
  std::vector<float> margin, grip;           // [n] of what stands on a sole, m and a coefficient
  std::vector<std::uint8_t> tips;            // [n] 1: the centre of pressure left the sole

  Player(std::string player, DrawingServos moved_by, std::size_t n)
      : name(std::move(player)),
        servos(std::move(moved_by)),
        drawn(n),
        rms(n),
        worst(n),
        off_plane(n),
        torque(n * dof()),
        speed(torque.size()),
        faster(n),
        off_board(n),
        beyond_limit(n),
        limit_joint(n),
        by_torque(n),
        margin(n),
        grip(n),
        tips(n) {}

  std::size_t dof() const { return static_cast<std::size_t>(servos.body().dof()); }

  void set(std::size_t i, const Replay& replay, const Fastest& fastest, const RobotOnPlane& robot) {
    const ReplayErrors errors = replay_errors(replay, robot.plane());
    rms[i] = static_cast<float>(errors.rms);
    worst[i] = static_cast<float>(errors.worst);
    off_plane[i] = static_cast<float>(errors.off_plane);
    for (std::size_t k = 0; k < dof(); ++k) {
      torque[i * dof() + k] = static_cast<float>(replay.torque[static_cast<Eigen::Index>(k)]);
      speed[i * dof() + k] = static_cast<float>(replay.speed[static_cast<Eigen::Index>(k)]);
    }
    off_board[i] = errors.off_plane > robot.off_plane_tolerance();
    beyond_limit[i] = replay.torque.maxCoeff() > 1 || replay.speed.maxCoeff() > 1;
    faster[i] = static_cast<float>(fastest.factor);
    limit_joint[i] = fastest.joint;
    by_torque[i] = fastest.by_torque;
    margin[i] = static_cast<float>(std::max(replay.margin, -kFarOutside));
    grip[i] = static_cast<float>(std::min(replay.grip, kNoGrip));
    tips[i] = replay.margin < 0;
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
    file.write(name + "/off_board", off_board);
    file.write(name + "/beyond_limit", beyond_limit);
    file.write(name + "/limit_joint", limit_joint);
    file.write(name + "/by_torque", by_torque);
    if (servos.stands()) {
      file.write(name + "/margin", margin);
      file.write(name + "/grip", grip);
      file.write(name + "/tips", tips);
    }
    file.attribute(name + ".joints", fmt::format("{}", fmt::join(servos.body().moving(), "\n")));
  }
};

// "27 of 27 digits leave the board, by up to 8.6 mm", and so on, where more than a share of them do.
std::string losses(const Player& player, const std::vector<std::uint8_t>& lost, std::size_t readable,
                   double tolerated) {
  if (player.off_board.empty()) return "";
  std::vector<std::string> words;
  const auto tell = [&](std::int64_t count, std::size_t all, const std::string& what) {
    if (static_cast<double>(count) > tolerated * static_cast<double>(all))
      words.push_back(fmt::format("{} of {} {}", count, all, what));
  };
  const std::size_t n = player.off_board.size();
  tell(
      std::ranges::count(player.off_board, 1), n,
      fmt::format("leave the board, by up to {:.1f} mm", 1000 * *std::ranges::max_element(player.off_plane)));
  tell(std::ranges::count(player.beyond_limit, 1), n, "ask a joint for more than its limit");
  if (player.servos.stands())
    tell(std::ranges::count(player.tips, 1), n,
         fmt::format("tip the robot over its sole, its centre of pressure up to {:.1f} mm outside",
                     -1000 * *std::ranges::min_element(player.margin)));
  tell(std::ranges::count(lost, 1), readable, "that could be read read otherwise or not at all");
  return fmt::format("{}", fmt::join(words, "; "));
}

// What a robot stands on, if it stands on a link: what touches the floor at rest. Told where it has no sole.
std::optional<Support> sole(const StageRun& stage, const Body& body, const RobotSettings& robot) {
  if (robot.stands_on.empty()) return {};
  const auto links = robot_links(stage, body.model(), robot);
  try {
    return Support(shape_corners(body, links, body.posture(robot.rest())), kTouching);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}: no centre of pressure: {}\n", robot.name, error.what());
    return {};
  }
}

// The movement along configurations, at the profile's pace or within the limits of the bodies.
PacedPath movement_along(const std::vector<double>& joints, const std::vector<float>& pen,
                         const DynamicsTable& table, const std::vector<Player*>& players) {
  const std::vector<double> times = times_at_pace(pen, joints, table.pace, table.joint_pace);
  const double longest = kMostSteps * std::min(table.step, table.smoothing);
  if (times.back() > longest)
    throw InputError(
        "dynamics: a digit takes {:.3g} s at pace = {} and joint_pace = {}, more than {:.0e} steps of {} s; "
        "expected a greater pace, step or smoothing",
        times.back(), table.pace, table.joint_pace, kMostSteps, std::min(table.step, table.smoothing));
  std::vector<const DrawingServos*> bodies;
  for (const Player* player : players)
    if (table.within_limits) bodies.push_back(&player->servos);
  return path_within_limits(joints, times, table.smoothing, bodies, table.step * table.control_every,
                            longest);
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
  std::vector<float> duration(n), travel(n), travel_of_elites(n);
  std::vector<std::uint8_t> before_images(n * kImagePixels);
  Drawn wanted_images(n), by_elites(n);
  Player arm(
      "arm",
      {std::make_shared<const Body>(robot.body().model(), s.robot.joints, s.robot.rest()), s.robot, s.gears},
      n);
  std::vector<Player*> players{&arm};
  std::optional<Player> whole;
  if (auto body = whole_body(robot.body().model(), s.robot, s.dynamics.lightest)) {
    std::optional<Support> stands = sole(stage, *body, s.robot);
    whole.emplace("whole", DrawingServos(std::move(body), s.robot, s.gears, std::move(stands)), n);
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
      const std::vector<double> joints =
          s.dynamics.postures == "elites" ? trace.joints : least_travel(robot, stack.stack.points(), trace);
      const PacedPath movement = movement_along(joints, trace.pen, s.dynamics, players);
      travel[i] = static_cast<float>(joint_travel(joints, robot.dof()));
      travel_of_elites[i] = static_cast<float>(joint_travel(trace.joints, robot.dof()));
      id[i] = digits.id[static_cast<std::size_t>(replayed[i])];
      duration[i] = static_cast<float>(movement.path.duration());
      model.draw(genome, length, before.data());
      image_to_bytes(before.data(), &before_images[i * kImagePixels]);
      for (Player* player : players) {
        const Replay played = player->servos.replay(robot.tip(), movement.path, servos);
        player->set(i, played, player->servos.fastest(movement, servos.step * servos.control_every), robot);
        draw_tip(played.tip, s.pencil.width(genome[2]), after);
        player->drawn.set(i, after, before);
        if (player != &arm) continue;
        draw_tip(played.wanted, s.pencil.width(genome[2]), after);
        wanted_images.set(i, after, before);
      }
      const PacedPath of_elites = movement_along(trace.joints, trace.pen, s.dynamics, {});
      draw_tip(exact_way(robot, of_elites.path, servos), s.pencil.width(genome[2]), after);
      by_elites.set(i, after, before);
    }
  });

  const Dataset dataset = read_dataset(stage.input("dataset"));
  const Judge judge(Hdf5Reader(stage.input("judge")), dataset, workers);
  const Verdicts verdicts = judge.judge(n, before_images.data(), workers);
  const auto readable = static_cast<std::size_t>(std::ranges::count(verdicts.good, 1));

  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  file.write("id", id);
  file.write("duration", duration);
  file.write("image", {n, kImageSide, kImageSide}, before_images.data());
  file.write("readable", verdicts.good);
  wanted_images.write(file, "wanted");
  file.write("wanted/travel", travel);
  by_elites.write(file, "elites");
  file.write("elites/travel", travel_of_elites);
  for (const Player* player : players) {
    player->write(file);
    const std::vector<std::uint8_t> lost =
        lost_digits(verdicts, judge.judge(n, player->drawn.image.data(), workers));
    file.write(player->name + "/lost", lost);
    if (const std::string told = losses(*player, lost, readable, s.dynamics.tolerated); !told.empty())
      fmt::print(stderr, "{}, {}: {}\n", robot.name(),
                 player == &arm ? "the drawing joints alone" : "the whole body", told);
  }
  file.close();
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "The digits replayed by a robot's servos", hbr::run);
}
