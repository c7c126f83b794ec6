#include "models/robot/plane/planar_body.h"

#include <fmt/format.h>

#include <numbers>

namespace hbr::inline robots {
namespace {

constexpr double kThickness = 0.012, kWidth = 0.028;  // m, of a link

const Eigen::Vector3f kBlue(0.30f, 0.47f, 0.66f), kGrey(0.30f, 0.33f, 0.37f);

Visual visual(Visual::Kind kind, const Eigen::Vector3d& centre, const Eigen::Vector3d& size,
              const Eigen::Vector3f& colour) {
  Visual result{kind, Eigen::Isometry3d::Identity(), "", size, colour};
  result.pose.translation() = centre;
  return result;
}

// About the frame's y, which is across the board; y grows behind it.
Visual round(const Eigen::Vector3d& centre, double radius, double length, const Eigen::Vector3f& colour) {
  Visual result = visual(Visual::Kind::cylinder, centre, {radius, radius, length}, colour);
  result.pose.rotate(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitX()));
  return result;
}

}  // namespace

RobotOnPlane planar_body(const std::vector<double>& links, double limit) {
  const auto n = static_cast<int>(links.size());
  RobotModel model;
  model.name = "planar arm";
  model.path = "the planar arm";
  const double base = -kThickness * (n + 1.5);
  model.links.push_back({"base", {}, {round({0, base, 0}, 1.2 * kWidth, kThickness, kGrey)}, -1, false});
  std::vector<std::string> moving;
  double before = 0;  // length of the link that the joint sits on
  for (int i = 0; i <= n; ++i) {
    Joint joint{};
    joint.name = i < n ? fmt::format("joint{}", i + 1) : "grip";
    joint.kind = i < n ? Joint::Kind::revolute : Joint::Kind::fixed;
    joint.parent = i;
    joint.child = i + 1;
    joint.origin = Eigen::Isometry3d::Identity();
    joint.origin.translation()[0] = before;
    joint.axis = -Eigen::Vector3d::UnitY();  // from x to z
    joint.lower = -limit;
    joint.upper = limit;
    model.joints.push_back(joint);
    if (i < n) moving.push_back(joint.name);

    Link link{i < n ? fmt::format("link{}", i + 1) : "pen", {}, {}, i, false};
    const double off = -kThickness * (n - i + 0.5);
    if (i < n) {
      link.visuals.push_back(visual(Visual::Kind::box, {links[i] / 2, off, 0},
                                    {links[i], 0.8 * kThickness, 0.7 * kWidth}, kBlue));
      for (const double end : {0., links[i]})
        link.visuals.push_back(round({end, off, 0}, kWidth / 2, 0.86 * kThickness, kBlue));
      link.visuals.push_back(round({0, off - 0.5 * kThickness, 0}, kWidth / 5, kThickness, kGrey));
      before = links[i];
    }
    model.links.push_back(std::move(link));
  }
  auto body = std::make_shared<const Body>(std::move(model), moving);
  return RobotOnPlane("arm", std::move(body), "pen",
                      {Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitZ(), 1});
}

}  // namespace hbr::inline robots
