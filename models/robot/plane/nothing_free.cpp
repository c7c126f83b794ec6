#include "models/robot/plane/nothing_free.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "pipeline/core/random.h"

namespace hbr::inline robots {

InputError nothing_free(const Body& body, const Clearance& clearance, int tip, int tried) {
  constexpr int kAsked = 200;
  Rng rng(Seed(0).child("nothing_free"));
  std::map<int, int> blocks;  // by link, -1 the robot itself
  for (int i = 0; i < kAsked; ++i) {
    Eigen::VectorXd joints(body.dof());
    for (Eigen::Index k = 0; k < body.dof(); ++k)
      joints[k] = body.lower()[k] + (body.upper()[k] - body.lower()[k]) * rng.uniform_double();
    ++blocks[clearance.blocker(joints.data()).value_or(-1)];
  }
  const int most = std::ranges::max_element(blocks, {}, [](const auto& b) { return b.second; })->first;
  const auto& links = body.model().links;
  return InputError(
      "{}: in none of {} configurations of {} can '{}' touch a board: {}", body.model().path.string(), tried,
      fmt::join(body.moving(), ", "), links[tip].name,
      most < 0
          ? "the robot runs into itself; expected joints, or a posture of the others (rest_joints), that "
            "leave "
            "it free"
          : fmt::format(
                "link '{}' reaches beyond it whichever way a board faces; expected a tip_link farther out, "
                "such as a link of its own for the pen's point",
                links[most].name));
}

}  // namespace hbr::inline robots
