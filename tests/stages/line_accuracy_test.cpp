// The accuracy of lines and of the reference, by brute force.
#include "stages/studies/line_accuracy.h"

#include <gtest/gtest.h>

#include "tests/stages/random_hierarchy.h"

namespace hbr {
namespace {

constexpr int kRequests = 500;

class LineAccuracy : public testing::Test {
 protected:
  Hierarchy hierarchy_{400, Seed(1)};
  const PointLayer& points_ = hierarchy_.stack.points();
  LineRequests requests_ = draw_line_requests(kRequests, points_, kLongestLine, Rng(Seed(2)));

  // Squared distance between the displacement that is wanted and one between two elites of layer 1.
  double error(std::size_t i, const Eigen::Vector2d& end) const {
    return (end - hierarchy_.position(requests_.start[i]) - requests_.wanted[i]).squaredNorm();
  }
};

TEST_F(LineAccuracy, RequestsAreAsLongAsLinesAndGoEverywhere) {
  double length = 0;
  Eigen::Vector2d sum(0, 0);
  for (std::size_t i = 0; i < kRequests; ++i) {
    ASSERT_LT(requests_.wanted[i].norm(), kLongestLine);
    ASSERT_LT(requests_.start[i], 400);
    length += requests_.wanted[i].norm() / kRequests;
    sum += requests_.wanted[i].normalized() / kRequests;
  }
  EXPECT_NEAR(length, kLongestLine / 2, 4 * kLongestLine / std::sqrt(12. * kRequests));
  EXPECT_LT(sum.norm(), 4 / std::sqrt(kRequests));
}

TEST_F(LineAccuracy, OfALayerIsThatOfItsNearestLine) {
  const std::vector<float> errors =
      squared_line_errors(requests_, points_, kFrame, hierarchy_.stack.layer(1));
  ASSERT_EQ(errors.size(), static_cast<std::size_t>(kRequests));
  for (std::size_t i = 0; i < kRequests; ++i) {
    Rows command(1, 2);
    command.row(0) = kFrame.line_descriptor(requests_.wanted[i]).cast<float>().transpose();
    EXPECT_NEAR(static_cast<double>(errors[i]), error(i, hierarchy_.line(requests_.start[i], command)[1]),
                1e-7);
  }
}

TEST_F(LineAccuracy, OfTheReferenceIsThatOfItsElitesEndAndRequest) {
  Rng rng(Seed(3));
  const Elites reference = random_elites(300, 2, 4, rng);
  Workers workers(2);
  const ReferenceErrors errors = squared_reference_errors(requests_, points_, kFrame, reference, workers);
  for (std::size_t i = 0; i < kRequests; ++i) {
    const Eigen::Vector2d from = hierarchy_.position(requests_.start[i]);
    Eigen::Vector4d asked;
    asked << kFrame.point_descriptor(from), kFrame.line_descriptor(requests_.wanted[i]);
    const int found = nearest(reference.measures, asked);
    const Eigen::Vector4d measured = reference.measures.row(found).transpose().cast<double>();
    const Eigen::Vector2d end = kFrame.point(measured.head<2>()) + kFrame.line(measured.tail<2>()),
                          request = from + decode_line(kFrame, reference.solution.row(found).data());
    const auto reached = [&](const Eigen::Vector2d& place) {
      return hierarchy_.position(hierarchy_.start_at(place));
    };
    EXPECT_NEAR(static_cast<double>(errors.endpoint[i]), error(i, reached(end)), 1e-7);
    EXPECT_NEAR(static_cast<double>(errors.displacement[i]), error(i, reached(request)), 1e-7);
  }
}

}  // namespace
}  // namespace hbr
