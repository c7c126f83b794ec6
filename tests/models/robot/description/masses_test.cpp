// Impossible masses: harmless where what they are fixed to makes up for them, else told or refused.
#include "models/robot/description/masses.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "models/robot/body/body.h"
#include "models/robot/description/parts.h"
#include "pipeline/core/check.h"
#include "tests/models/robot/description/urdf_text.h"

namespace hbr {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Kind = MassFault::Kind;

std::string moments(double x, double y, double z) {
  return fmt::format(R"(ixx="{}" iyy="{}" izz="{}")", x, y, z);
}
// a - j - b, c fixed to b.
RobotModel with(const std::string& b, const std::string& c = "") {
  return load(link("a") + link("b", b) + link("c", c) + joint("j", "a", "b") + joint("k", "b", "c", "fixed"));
}

Eigen::Matrix3d diagonal(double x, double y, double z) { return Eigen::Vector3d(x, y, z).asDiagonal(); }

TEST(MassFault, KnowsBodies) {
  const Eigen::Vector3d here(0, 0, 0);
  EXPECT_EQ(mass_fault(1, here, diagonal(1, 2, 3)).kind, Kind::none);  // a plate: the limit
  EXPECT_EQ(mass_fault(1, here, diagonal(1e-9, 1e-9, 1e-9)).kind, Kind::none);
  EXPECT_EQ(mass_fault(1, here, diagonal(1, 2, 3.029)).kind, Kind::rounded);
  EXPECT_EQ(mass_fault(1, here, diagonal(1, 3.031, 2)).kind, Kind::lopsided);
  EXPECT_EQ(mass_fault(1, here, diagonal(0, 1, 1)).kind, Kind::not_positive);
  EXPECT_EQ(mass_fault(1, here, diagonal(-1, 1, 1)).kind, Kind::not_positive);
  EXPECT_EQ(mass_fault(0, here, diagonal(1, 1, 1)).kind, Kind::not_positive);
  // What is left of a point mass after it was added up far from the origin is rounding.
  EXPECT_EQ(mass_fault(1, {1, 0, 0}, diagonal(1e-15, 1e-15, 1e-15)).kind, Kind::not_positive);
}

TEST(MassFault, NearestPossibleKeepsWhatCanBe) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).matrix();
  const auto nearest = [&](double x, double y, double z) -> Eigen::Matrix3d {
    return turn.transpose() * nearest_possible(turn * diagonal(x, y, z) * turn.transpose()) * turn;
  };
  EXPECT_LT((nearest(1, 2, 2.5) - diagonal(1, 2, 2.5)).norm(), 1e-12);
  EXPECT_LT((nearest(1, 4, 2) - diagonal(1, 3, 2)).norm(), 1e-12);
  EXPECT_LT((nearest(-1, 1, 2) - diagonal(0, 1, 1)).norm(), 1e-12);
}

TEST(Masses, CountTogetherWhereTheyAreFixed) {
  const std::string point = inertial("0.5", moments(0, 0, 0));
  const RobotModel model = with(inertial(), point);
  EXPECT_THAT(mass_oddities(model),
              ElementsAre(HasSubstr("links 'c': mass or inertia that no body has; with")));
  const Body body(model, {"j"});
  EXPECT_NEAR(body.mass(), 2.5, 1e-12);
  Equations equations;
  EXPECT_NO_THROW(body.equations(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1), {0, 0, 0}, equations));
  // b's own about the joint, and the point mass on its circle about the joint's axis.
  const Eigen::Vector3d at = model.joints[1].origin.translation();
  EXPECT_NEAR(equations.mass(0, 0), 1 + 0.5 * at.head<2>().squaredNorm(), 1e-12);

  EXPECT_THAT(mass_oddities(with(inertial(), inertial("0"))), ElementsAre(HasSubstr("links 'c'")));
  EXPECT_THAT(mass_oddities(with(inertial(), inertial("0", moments(0, 0, 0)))), ElementsAre());
  EXPECT_THAT(mass_oddities(with(point, inertial())), ElementsAre(HasSubstr("links 'b'")));
  EXPECT_THAT(mass_oddities(with(inertial(), inertial("1e-6", moments(-1e-3, 1e-3, 1e-3)))),
              ElementsAre(HasSubstr("links 'c'")));
}

TEST(Masses, OffByRoundingAreTaken) {
  const RobotModel model = with(inertial("1", moments(1, 2, 3.02)));
  EXPECT_THAT(mass_oddities(model),
              ElementsAre(HasSubstr("links 'b': principal moments of inertia 1, 2, 3.02")));
  Equations equations;
  Body(model, {"j"}).equations(Eigen::VectorXd::Zero(1), Eigen::VectorXd::Zero(1), {0, 0, 0}, equations);
  EXPECT_NEAR(equations.mass(0, 0), 3, 1e-12);
}

TEST(Masses, OfNoBodyCanDrawAndHaveNoDynamics) {
  const RobotModel lopsided = with(inertial("1", moments(1, 1, 2.5)));
  EXPECT_THAT(mass_oddities(lopsided),
              ElementsAre(HasSubstr("larger than the sum of the other two; they can draw")));
  const Body body(lopsided, {"j"});
  EXPECT_EQ(body.link_poses(Eigen::VectorXd::Zero(1)).size(), 3u);
  const auto why = [](const Body& b) {
    Equations equations;
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(b.dof());
    try {
      b.equations(zero, zero, {0, 0, 0}, equations);
    } catch (const InputError& error) {
      EXPECT_EQ(b.impossible_dynamics(), error.what());
      return std::string(error.what());
    }
    EXPECT_EQ(b.impossible_dynamics(), "");
    return std::string("no complaint");
  };
  EXPECT_THAT(why(body),
              HasSubstr("link 'b' and what is fixed to it: principal moments of inertia 1, 1, 2.5"));
  EXPECT_EQ(why(Body(lopsided, {"j"}, {}, "b")), "no complaint");  // stands still itself

  // Nor has what has no mass at all.
  const RobotModel light = with("");
  EXPECT_THAT(mass_oddities(light),
              ElementsAre(HasSubstr("links 'b': the mass is 0 kg; expected more than 0; they")));
  EXPECT_EQ(Body(light, {"j"}).link_poses(Eigen::VectorXd::Zero(1)).size(), 3u);
  EXPECT_THAT(why(Body(light, {"j"})), HasSubstr("link 'b' and what is fixed to it: the mass is 0 kg"));

  // The root stands still, unless another link does.
  const RobotModel root =
      load(link("a", inertial("1", moments(-1, 1, 1))) + link("b") + joint("j", "a", "b"));
  EXPECT_THAT(mass_oddities(root), ElementsAre(HasSubstr("links 'a': principal moments")));
  EXPECT_EQ(why(Body(root, {"j"})), "no complaint");
  EXPECT_THAT(why(Body(root, {"j"}, {}, "b")), HasSubstr("link 'a'"));
}

}  // namespace
}  // namespace hbr
