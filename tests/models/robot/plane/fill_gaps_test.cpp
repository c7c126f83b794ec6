// On a chain in its plane: what it reaches is a disc.
#include "models/robot/plane/fill_gaps.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "pipeline/hierarchy/joints.h"
#include "pipeline/qd/places.h"
#include "tests/models/robot/plane/three_links.h"

namespace hbr {
namespace {

// Elites with these joints.
Elites elites_of(const std::vector<Eigen::Vector3d>& all) {
  Elites elites;
  const auto n = static_cast<Eigen::Index>(all.size());
  elites.solution.resize(n, 3);
  elites.measures = Rows::Zero(n, 2);
  elites.objective = Eigen::VectorXf::Zero(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    elites.solution.row(i) = encode_joints(three_links(), all[static_cast<std::size_t>(i)]).transpose();
    elites.id.push_back(10 + i);
    elites.parent.push_back(-1);
    perform_point(three_links(), kFrame, elites, i);
  }
  return elites;
}

TEST(FillGaps, FillsExactlyWhatCanBeReached) {
  Rows points(0, 2);
  for (int i = 0; i < 9; ++i)
    for (int k = 0; k < 9; ++k) {
      points.conservativeResize(points.rows() + 1, Eigen::NoChange);
      points.row(points.rows() - 1) =
          Eigen::RowVector2f(0.06f + 0.11f * static_cast<float>(i), 0.06f + 0.11f * static_cast<float>(k));
    }
  const Elites before = elites_of({{0.3, 0.5, 0.4}, {-0.5, 0.8, -0.3}});
  Elites after = before;
  fill_gaps(three_links(), kFrame, points, 0.02f, after, Seed(1));
  ASSERT_GT(after.size(), 30);
  EXPECT_EQ(after.solution.topRows(2), before.solution);

  const std::vector<float> distance = nearest_elites(points, after).distance;
  for (Eigen::Index i = 0; i < points.rows(); ++i) {
    const double from_base = kFrame.point(points.row(i).transpose().cast<double>()).norm();
    const float apart = distance[static_cast<std::size_t>(i)];
    EXPECT_TRUE(apart <= 0.02f || from_base > 2.9) << apart << " at " << from_base;
    EXPECT_TRUE(apart > 0.02f || from_base < 3.2) << apart << " at " << from_base;
  }
  // From one gap to the next: none is left to inverse kinematics that starts anywhere.
  const auto lost = std::ranges::count(after.parent.begin() + 2, after.parent.end(), -1);
  EXPECT_EQ(lost, 0);
  for (Eigen::Index row = 2; row < after.size(); ++row) {
    EXPECT_EQ(after.id[static_cast<std::size_t>(row)], 10 + row);
    const std::int64_t parent = after.parent[static_cast<std::size_t>(row)];
    EXPECT_TRUE(parent == -1 || (parent >= 10 && parent < 10 + row)) << parent;
    // It stands where it says, clear of itself, and its place was a gap.
    Eigen::Vector3d joints;
    decode_joints(three_links(), after.solution.row(row).data(), joints.data());
    Pen pen;
    three_links().pens(1, joints.data(), &pen);
    EXPECT_LT(
        (kFrame.point_descriptor(pen.position).cast<float>() - after.measures.row(row).transpose()).norm(),
        1e-6);
    EXPECT_NEAR(after.objective[row], -joint_variance(joints.data(), 3), 1e-6);
    EXPECT_TRUE(three_links().clear(joints.data(), kFrame.half_side));
    Elites others = after;
    others.measures = after.measures.topRows(row);
    EXPECT_GT(nearest_elites(after.measures.row(row), others).distance[0], 0.02f - kTolerance / 6);
  }
}

TEST(FillGaps, LeavesWhatHasElitesAlone) {
  const Elites before = elites_of({{0.3, 0.5, 0.4}, {-0.5, 0.8, -0.3}});
  Elites after = before;
  fill_gaps(three_links(), kFrame, before.measures, 0.02f, after, Seed(1));
  EXPECT_EQ(after.size(), 2);
  EXPECT_EQ(after.solution, before.solution);
}

// An elite that is off its place comes to it, and its errors are what is left.
TEST(PointsOnPlane, ProjectedElitesStandAtTheirPlaces) {
  Elites elites = elites_of({{0.3, 0.5, 0.4}, {-0.5, 0.8, -0.3}});
  elites.measures.array() += 0.003f;
  for (Eigen::Index row = 0; row < 2; ++row) {
    const Eigen::Vector3d place = place_of(three_links(), kFrame, elites, row);
    const Rows asked = elites.measures.row(row);
    const Eigen::VectorXd joints = project_point(three_links(), kFrame, elites, row);
    const PointErrors errors = point_errors(three_links(), place, joints);
    EXPECT_LT(errors.distance, 1e-4);
    EXPECT_LT(errors.off_plane, 1e-9);
    EXPECT_NEAR(errors.variance, joint_variance(joints.data(), 3), 1e-15);
    EXPECT_LT((elites.measures.row(row) - asked).norm(), 1e-4f);
    const PointErrors moved = point_errors(three_links(), place + Eigen::Vector3d(0.3, 0, 0.4), joints);
    EXPECT_NEAR(moved.distance, 0.5, 1e-3);
  }
}

}  // namespace
}  // namespace hbr
