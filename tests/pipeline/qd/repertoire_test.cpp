// The distance archive's rule against a plain second implementation.
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/qd/distance_archive.h"
#include "tests/pipeline/qd/solutions.h"

namespace hbr {
namespace {

// The rule of archive-curiosity written down once more, without any structure.
class PlainArchive {
 public:
  PlainArchive(float l, float eps, Contest contest) : l_(l), eps_(eps), contest_(contest) {}
  Admission add(const Solution& s) {
    std::vector<std::pair<float, int>> near = sorted(s, -1);
    if (near.empty() || near[0].first > l_) return held_.push_back(s), Admission::kNovel;
    if (held_.size() == 1 || near[1].first < (1 - eps_) * l_) return Admission::kRejected;
    Solution& other = held_[near[0].second];
    const float q = s.fitness, q0 = other.fitness;
    if (contest_ == Contest::kFitness)
      return q > q0 ? (other = s, Admission::kReplaced) : Admission::kRejected;
    const float n = mean15(near), n0 = mean15(sorted(other, near[0].second));
    const float sign = q0 > 0 ? 1 : q0 < 0 ? -1 : 0;
    if (q >= (1 - sign * eps_) * q0 && n >= (1 - eps_) * n0 &&
        (q - q0) * std::abs(n0) > -(n - n0) * std::abs(q0))
      return other = s, Admission::kReplaced;
    return Admission::kRejected;
  }
  const std::vector<Solution>& held() const { return held_; }

 private:
  std::vector<std::pair<float, int>> sorted(const Solution& s, int excluded) const {
    std::vector<std::pair<float, int>> near;
    for (int i = 0; i < static_cast<int>(held_.size()); ++i) {
      if (i == excluded) continue;
      float d2 = 0;
      for (std::size_t d = 0; d < s.descriptor.size(); ++d)
        d2 += (s.descriptor[d] - held_[i].descriptor[d]) * (s.descriptor[d] - held_[i].descriptor[d]);
      near.emplace_back(std::sqrt(d2), i);
    }
    std::sort(near.begin(), near.end());
    return near;
  }
  static float mean15(const std::vector<std::pair<float, int>>& near) {
    const std::size_t k = std::min<std::size_t>(15, near.size());
    float sum = 0;
    for (std::size_t i = 0; i < k; ++i) sum += near[i].first;
    return sum / static_cast<float>(k);
  }
  float l_, eps_;
  Contest contest_;
  std::vector<Solution> held_;
};

void decides_as_the_rule_says(Contest contest) {
  for (const int d : {1, 2, 3, 4, 5})
    for (const float sign : {-1.0f, 1.0f, 0.0f}) {
      const float l = d == 1 ? 0.01f : 0.06f * d;
      const auto archive = make_distance_archive(4, d, {l, 0.1f, 15, 0, 1, contest});
      PlainArchive plain(l, 0.1f, contest);
      Rng rng(Seed(6).child(d));
      int replaced = 0;
      for (int id = 0; id < 2500; ++id) {
        const Solution s = random_solution(rng, id, d, sign);
        const Added added = archive->add(s.candidate());
        ASSERT_EQ(added.admission, plain.add(s)) << "d " << d << ", candidate " << id;
        replaced += added.admission == Admission::kReplaced;
      }
      ASSERT_EQ(archive->size(), static_cast<Slot>(plain.held().size()));
      for (Slot i = 0; i < archive->size(); ++i) EXPECT_EQ(archive->store().id(i), plain.held()[i].id);
      // Both rules are strict: with equal fitness 0 nothing is ever replaced.
      EXPECT_EQ(replaced > 5, sign != 0) << replaced;
    }
}

TEST(DistanceArchive, DecidesAsTheRuleSays) { decides_as_the_rule_says(Contest::kDominance); }
TEST(DistanceArchive, WithLocalCompetitionTheFitterStays) { decides_as_the_rule_says(Contest::kFitness); }

// Of two elites as near, the older slot is the one to beat.
TEST(DistanceArchive, ATieGoesToTheLowerSlot) {
  const auto archive = make_distance_archive(4, 2, {0.2f, 0.1f, 1, 0, 1});
  const std::vector<float> genome(4);
  std::int64_t id = 0;
  const auto add = [&](float x, float y, float fitness) {
    const Solution s{genome, {x, y}, fitness, id++};
    return archive->add(s.candidate());
  };
  add(0.625f, 0.5f, -1);
  add(0.25f, 0.5f, -1);
  add(0.625f, 0.703125f, -1);  // neighbours, so that both are little novel
  add(0.25f, 0.703125f, -1);
  ASSERT_EQ(archive->size(), 4);
  const Added added = add(0.4375f, 0.5f, -0.1f);
  EXPECT_EQ(added.admission, Admission::kReplaced);
  EXPECT_EQ(added.slot, 0);
}

}  // namespace
}  // namespace hbr
