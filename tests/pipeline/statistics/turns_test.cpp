// How sharply digits turn, and what goes with it, by pairs and by closed forms.
#include <gmock/gmock.h>

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "pipeline/core/random.h"
#include "pipeline/statistics/collect.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using nlohmann::json;

struct Digit {
  std::vector<float> turn;  // rad
  std::vector<std::uint8_t> joint;
  bool good;
  float length = 2, side = 0.5f;

  double mean_degrees() const {
    double sum = 0;
    for (const float t : turn) sum += std::abs(static_cast<double>(t)) * 180 / std::numbers::pi;
    return sum / static_cast<double>(turn.size());
  }
};
using Digits = std::vector<Digit>;

void write(Hdf5Writer& file, const std::string& group, const Digits& digits) {
  std::vector<std::int32_t> turns;
  std::vector<float> turn, length, side;
  std::vector<std::uint8_t> joint, good;
  for (const Digit& d : digits) {
    turns.push_back(static_cast<std::int32_t>(d.turn.size()));
    turn.insert(turn.end(), d.turn.begin(), d.turn.end());
    joint.insert(joint.end(), d.joint.begin(), d.joint.end());
    good.push_back(d.good ? 1 : 0);
    length.push_back(d.length);
    side.push_back(d.side);
  }
  file.write(group + "/turns", turns);
  file.write(group + "/turn", turn);
  file.write(group + "/joint", joint);
  file.write(group + "/good", good);
  file.write(group + "/length", length);
  file.write(group + "/side", side);
}

class Turns : public testing::Test {
 protected:
  json collected(const Digits& hbr, const Digits& flat) { return collected({{hbr, flat}}); }
  // Of replications, each with the hierarchy's digits and flat ones.
  json collected(const std::vector<std::pair<Digits, Digits>>& replications) {
    std::map<std::string, std::filesystem::path> files;
    for (const auto& [hbr, flat] : replications) {
      const std::string name = fmt::format("{:02}.h5", files.size());
      Hdf5Writer file(folder_.path() / name);
      write(file, "hbr", hbr);
      write(file, "flat", flat);
      file.close();
      files["digit_turns/" + name] = folder_.path() / name;
    }
    return collect_statistics("tiny", files);
  }
  // One turn each: `level` tenths of the sharpest, in the order given.
  static Digits one_turn(const std::vector<std::pair<int, bool>>& levels_and_good) {
    Digits digits;
    for (const auto& [level, good] : levels_and_good)
      digits.push_back({{0.1f * static_cast<float>(level) + 0.05f}, {0}, good});
    return digits;
  }
  TemporaryFolder folder_;
};

double number(const json& found, const std::string& name) {
  return found["numbers"]["digit_turns." + name]["value"].get<double>();
}

TEST_F(Turns, AgainstTheirDefinitions) {
  Rng rng(Seed(4));
  const auto some = [&](double sharp) {
    Digits digits;
    for (int i = 0; i < 40; ++i) {
      Digit d{{}, {}, rng.uniform() < 0.5f, rng.uniform(1, 3), rng.uniform(0.2f, 0.4f)};
      const auto turns = rng.below(8);  // some have none
      for (std::uint32_t k = 0; k < turns; ++k) {
        d.turn.push_back(static_cast<float>(sharp) * rng.uniform(-1, 1));
        d.joint.push_back(k == 3 ? 1 : 0);
      }
      digits.push_back(d);
    }
    return digits;
  };
  const Digits hbr = some(0.5), flat = some(1.5);
  const json found = collected(hbr, flat);
  const auto quantity = [&](const std::string& name) {
    return found["quantities"]["digit_turns." + name]["median"].get<double>();
  };
  for (const auto& [group, digits] : {std::pair{std::string("hbr"), hbr}, {std::string("flat"), flat}}) {
    double turn = 0, curvature = 0, turned = 0, sum[2] = {0, 0}, count[2] = {0, 0}, won = 0, pairs = 0;
    for (const Digit& d : digits) {
      for (std::size_t k = 0; k < d.turn.size(); ++k) {
        sum[d.joint[k]] += std::abs(static_cast<double>(d.turn[k])) * 180 / std::numbers::pi;
        count[d.joint[k]] += 1;
      }
      if (d.turn.empty()) continue;
      turned += 1;
      turn += d.mean_degrees();
      curvature += d.mean_degrees() * static_cast<double>(d.turn.size()) * d.side / d.length;
      for (const Digit& other : digits)
        if (!d.good && other.good && !other.turn.empty())
          pairs += 1, won += d.mean_degrees() > other.mean_degrees() ? 1 : 0;
    }
    EXPECT_NEAR(quantity(group + ".turn"), turn / turned, 1e-9);
    EXPECT_NEAR(quantity(group + ".curvature"), curvature / turned, 1e-4);
    EXPECT_NEAR(quantity(group + ".within"), sum[0] / count[0], 1e-9);
    EXPECT_NEAR(quantity(group + ".joints"), sum[1] / count[1], 1e-9);
    EXPECT_NEAR(number(found, group + ".refused_turn_more"), won / pairs, 1e-12);
    EXPECT_FALSE(found["numbers"].contains("digit_turns." + group + ".refused_turn_more_low")) << "of one";
    EXPECT_EQ(found["boxes"]["digit_turns." + group + ".of_good"]["n"].get<int>() +
                  found["boxes"]["digit_turns." + group + ".of_refused"]["n"].get<int>(),
              turned);
  }
  EXPECT_GT(number(found, "flat_turn_more"), 0.6);
}

// Whether a digit is good hangs on its turns alone in each replication; or in one, the other way round in
// another, and not at all in the third. All digits together would hide that.
TEST_F(Turns, IntervalsTellAReasonFromNone) {
  std::vector<std::pair<int, bool>> reason, reverse, none;
  for (int level = 0; level < 10; ++level)
    for (int i = 0; i < 12; ++i) {
      reason.emplace_back(level, level < 5);
      reverse.emplace_back(level, level >= 5);
      none.emplace_back(level, i % 2 > 0);
    }
  const Digits flat = one_turn(reason);
  const json found = collected({{flat, flat}, {one_turn(reverse), flat}, {one_turn(none), flat}});
  EXPECT_EQ(number(found, "flat.refused_turn_more"), 1);
  EXPECT_EQ(number(found, "flat.refused_turn_more_low"), 1);
  EXPECT_NEAR(number(found, "hbr.refused_turn_more"), 0.5, 1e-12);
  EXPECT_LT(number(found, "hbr.refused_turn_more_low"), 0.05);
  EXPECT_GT(number(found, "hbr.refused_turn_more_high"), 0.95);
  EXPECT_NEAR(number(found, "flat_turn_more"), 0.5, 1e-12);
}

TEST_F(Turns, RefusesWhatDoesNotFitTogether) {
  Digits digits = one_turn({{1, true}, {2, false}});
  EXPECT_NO_THROW(collected(digits, digits));
  digits[0].joint.clear();
  EXPECT_THROW(collected(digits, digits), InputError);
}

}  // namespace
}  // namespace hbr
