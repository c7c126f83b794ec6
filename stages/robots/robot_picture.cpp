// Pictures of a robot that draws a digit: one posture, a strip of poses, and the posed body as .glb.
#include <opencv2/imgproc.hpp>

#include "models/robot/looks/picture.h"
#include "models/robot/plane/plane_file.h"
#include "pipeline/artifact/stage.h"
#include "pipeline/hierarchy/drawing_settings.h"
#include "stages/robots/robot_links.h"

namespace hbr::inline stages {
namespace {

struct PictureStage {
  double half_side = 0;
  int height = 0;
  RobotSettings robot;
};

template <class Fields>
void describe(Fields& f, PictureStage& s) {
  describe_half_side(f, s.half_side);
  f.number("height", s.height, Range{60, 6000}, "of the posture's picture, pixels");
  f.table("robot", s.robot, "the robot");
}

DrawnStroke read_drawing(const std::filesystem::path& path, const Robot& robot) {
  const Hdf5Reader file(path);
  const auto joints = file.read<float>("picture/joints"), pen = file.read<float>("picture/pen");
  if (joints.shape.size() != 2 || pen.shape.size() != 2 || pen.shape[1] != 2 || pen.shape[0] == 0 ||
      joints.shape[0] != pen.shape[0] || joints.shape[1] != static_cast<std::size_t>(robot.dof()))
    throw InputError(
        "{}: picture/joints and picture/pen do not fit robot '{}'; expected [m x {}] and [m x 2]",
        path.string(), robot.name(), robot.dof());
  DrawnStroke drawing;
  drawing.joints.assign(joints.values.begin(), joints.values.end());
  for (std::size_t i = 0; i < pen.shape[0]; ++i)
    drawing.pen.emplace_back(pen.values[2 * i], pen.values[2 * i + 1]);
  return drawing;
}

constexpr double kViewRad = 0.42;
constexpr int kPoses = 5;

void run(StageRun& stage) {
  const auto settings = settings_from_json<PictureStage>(stage.settings(), stage.name());
  const DrawingPlane plane = load_plane(stage.input("plane"));
  const RobotOnPlane robot = make_robot(settings.robot, plane);
  const auto links = robot_links(stage, robot.body().model(), settings.robot);
  const DrawnStroke drawing = read_drawing(stage.input("transfer"), robot);
  const std::size_t last = drawing.pen.size() - 1;
  std::filesystem::create_directories(stage.output());

  const Scene finished = drawing_scene(robot, links, drawing, last, settings.half_side);
  const Camera front = camera_for(finished, view_from_front(plane), kViewRad, 4. / 5);
  write_png(stage.output() / "posture.png",
            render(finished, front, settings.height * 4 / 5, settings.height));
  save_scene(stage.output() / "posture.glb", "glb2", finished.bodies);

  const int pose_height = settings.height * 3 / 8, pose_width = pose_height * 3 / 4;
  const Camera shoulder = camera_for(finished, view_over_shoulder(plane), kViewRad, 3. / 4);
  std::vector<cv::Mat> poses;
  for (int i = 0; i < kPoses; ++i) {
    const Scene scene = drawing_scene(robot, links, drawing, last * (i + 1) / kPoses, settings.half_side);
    poses.push_back(render(scene, shoulder, pose_width, pose_height));
    stage.progress(i + 1, kPoses, "poses");
  }
  cv::Mat strip;
  cv::hconcat(poses, strip);
  write_png(stage.output() / "strip.png", strip);
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) {
  return hbr::stage_main(argc, argv, "Pictures of a robot that draws", hbr::run);
}
