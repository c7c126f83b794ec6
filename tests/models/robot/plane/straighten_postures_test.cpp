#include "models/robot/plane/straighten_postures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tests/models/robot/plane/three_links.h"

namespace hbr {
namespace {

double sum_of_squared_turns(const std::vector<Eigen::VectorXd>& way) {
  double sum = 0;
  for (std::size_t k = 1; k < way.size(); ++k) sum += (way[k] - way[k - 1]).squaredNorm();
  return sum;
}

// The pen moves as by even turns, the arm to and fro. A posture that is kept may be a rounding beyond a
// limit, as genes become joints by a sum.
TEST(Straightened, IsEvenBesideAPostureThatIsKept) {
  const RobotOnPlane& robot = three_links();
  const Eigen::Vector3d first(robot.upper()[0], -1, 0.8), turn(-0.1, 0.05, 0.1), aside(-0.2, 0.1, 0.1);
  std::vector<Eigen::Vector3d> places;
  std::vector<Eigen::VectorXd> way, even;
  for (int k = 0; k <= 6; ++k) {
    even.emplace_back(first + static_cast<double>(k) * turn);
    places.push_back(robot.body().position(robot.tip(), even.back().data()));
    way.emplace_back(even.back() + static_cast<double>(k % 2) * aside);
  }
  std::vector<bool> kept(way.size(), false);
  kept[0] = true;
  const std::vector<Eigen::VectorXd> straight = straightened(robot, places, way, kept);
  EXPECT_EQ(straight[0], way[0]);
  EXPECT_LT(sum_of_squared_turns(straight), 1.05 * sum_of_squared_turns(even));
  EXPECT_GT(sum_of_squared_turns(way), 2 * sum_of_squared_turns(even));
  for (std::size_t k = 0; k < way.size(); ++k)
    EXPECT_LT((robot.body().position(robot.tip(), straight[k].data()) - places[k]).norm(), 1e-3);

  std::vector<Eigen::VectorXd> beyond = way;
  beyond[0][0] = std::nextafter(beyond[0][0], std::numeric_limits<double>::infinity());
  EXPECT_EQ(straightened(robot, places, beyond, kept), straight);
}

}  // namespace
}  // namespace hbr
