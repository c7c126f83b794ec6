// Which digits are told to be the worst, and of what.
#include "reports/figures/worst_digits.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

using testing::HasSubstr;

class WorstDigits : public testing::Test {
 protected:
  std::filesystem::path place(const std::string& name, int replication) const {
    return folder_.path() / fmt::format("{}_{}.h5", name, replication);
  }
  // Digits 10, 20, 30 that differ by these; of the worst, 30 and 10, the places that lack what.
  std::filesystem::path transfer(int replication, const std::vector<float>& absolute,
                                 const std::vector<std::int32_t>& gap,
                                 const std::vector<std::int32_t>& limit) const {
    Hdf5Writer file(place("transfer", replication));
    file.write("id", std::vector<std::int64_t>{10, 20, 30});
    for (const char* form : {"", "evolved/"}) {
      const std::string group = form;
      file.write(group + "absolute", absolute);
      file.write(group + "worst/id", std::vector<std::int64_t>{30, 10});
      file.write(group + "worst/apart", std::vector<float>{0.025f, 0.004f});
      file.write(group + "worst/places", std::vector<std::int32_t>{40, 50});
      file.write(group + "worst/gap", gap);
      file.write(group + "worst/collision", std::vector<std::int32_t>{0, 0});
      file.write(group + "worst/limit", limit);
    }
    file.close();
    return place("transfer", replication);
  }
  std::filesystem::path replay(int replication, const std::vector<float>& arm,
                               const std::vector<float>& wanted,
                               const std::vector<std::uint8_t>& beyond) const {
    Hdf5Writer file(place("dynamics", replication));
    file.write("id", std::vector<std::int64_t>{10, 20, 30});
    file.write("arm/absolute", arm);
    file.write("wanted/absolute", wanted);
    file.write("arm/beyond_limit", beyond);
    file.close();
    return place("dynamics", replication);
  }
  TemporaryFolder folder_;
};

TEST_F(WorstDigits, AreOrderedOverReplicationsAndToldWhatMostPlacesLack) {
  Tables tables;
  const std::string html = worst_digits({transfer(0, {0.015625f, 0.0078125f, 0.046875f}, {3, 0}, {2, 0}),
                                         transfer(1, {0.03125f, 0.0078125f, 0.0625f}, {1, 2}, {5, 0})},
                                        {}, tables);
  EXPECT_EQ(tables["worst"].csv(),
            "form,replication,digit,absolute,cause\n"
            "as evolved,1,30,0.0625,limit\nas evolved,0,30,0.046875,gap\n"
            "as evolved,1,10,0.03125,gap\nas evolved,0,10,0.015625,offsets\n"
            "completed,1,30,0.0625,limit\ncompleted,0,30,0.046875,gap\n"
            "completed,1,10,0.03125,gap\ncompleted,0,10,0.015625,offsets\n");
  EXPECT_THAT(html, HasSubstr("of 40 places 1 in a gap of layer 1, 0 behind a collision, 5 beyond a joint’s "
                              "limit; up to 25.0\u202fmm apart<"));
  EXPECT_THAT(html, HasSubstr("each of 50 places has an elite within l; offsets add up to 4.00\u202fmm<"));
}

TEST_F(WorstDigits, OfReplaysAreThePosturesTheLimitsOrTheServos) {
  Tables tables;
  worst_digits({},
               {replay(0, {0.03125f, 0.046875f, 0.0625f}, {0.0234375f, 0.0078125f, 0.0078125f}, {1, 1, 0})},
               tables);
  EXPECT_THAT(tables["worst"].csv(), HasSubstr("replayed,0,30,0.0625,servos\nreplayed,0,20,"));
  EXPECT_THAT(tables["worst"].csv(), HasSubstr(",limit\nreplayed,0,10,0.03125,posture"));
}

TEST_F(WorstDigits, NothingIsShownOfRunsThatDidNotAsk) {
  Tables tables;
  EXPECT_EQ(worst_digits({}, {}, tables), "");
  EXPECT_TRUE(tables.empty());
}

TEST_F(WorstDigits, CountsFitTheDigits) {
  Tables tables;
  const auto path = transfer(0, {0.015625f, 0.0078125f, 0.046875f}, {3}, {2, 0});
  EXPECT_THAT([&] { worst_digits({path}, {}, tables); },
              testing::ThrowsMessage<InputError>(HasSubstr("worst/gap has 1 values; expected 2")));
}

}  // namespace
}  // namespace hbr
