#include "models/robot/looks/shapes.h"

#include <gtest/gtest.h>

#include "tests/models/robot/looks/mesh_volume.h"

namespace hbr {
namespace {

TEST(Shapes, HaveTheVolumeOfTheirBodies) {
  const double pi = 3.14159265358979;
  EXPECT_NEAR(volume({ellipsoid({1, 2, 3})}), 4 * pi / 3 * 6, 0.6);
  EXPECT_NEAR(volume({capsule(1, 3)}), pi * 3 + 4 * pi / 3, 0.3);
  EXPECT_NEAR(volume({cylinder(1, 2, 1e-3)}), 2 * pi, 0.05);
  EXPECT_NEAR(volume({torus(3, 1)}), 2 * pi * pi * 3, 2.);
  EXPECT_NEAR(volume({rounded_box({1, 2, 3}, 1e-3)}), 6, 0.3);
  EXPECT_NEAR(volume({rod({1, 0, 0}, {1, 5, 0}, .5)}), pi * .25 * 5 + pi / 6, 0.1);
  EXPECT_NEAR(volume({mirrored(capsule(1, 3))}), volume({capsule(1, 3)}), 1e-5);
}

}  // namespace
}  // namespace hbr
