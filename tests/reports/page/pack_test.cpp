#include "reports/page/pack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <cstring>
#include <limits>

#include "pipeline/core/check.h"
#include "pipeline/core/random.h"
#include "tests/support/unpacked.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Pack, ComesBackAsItWas) {
  Rng rng(Seed(1));
  std::vector<std::uint8_t> image;
  std::vector<std::uint16_t> way;
  std::vector<std::int32_t> id;
  std::vector<float> place{0.0f, -0.0f, 1e-42f, std::numeric_limits<float>::max(), -1.5f, 0.1f};
  for (int i = 0; i < 1000; ++i) {
    image.push_back(static_cast<std::uint8_t>(rng.below(256)));
    way.push_back(static_cast<std::uint16_t>(rng.below(65536)));
    id.push_back(static_cast<std::int32_t>(rng.below(4000000000u)));
    place.push_back(rng.uniform(-1, 1));
  }
  Pack pack("digits-00");
  pack.word("names", {"latent 1", "é <&>"});
  pack.word("replication", 3);
  pack.array("image", {10, 10, 10}, image);
  pack.array("way", {1000}, way);
  pack.array("id", {1000, 1}, id);
  pack.array("place", {503, 2}, place);
  pack.array("none", {0, 28}, std::vector<float>{});
  const std::string html = pack.html();
  EXPECT_TRUE(html.starts_with("<script type=\"text/plain\" id=\"pack-digits-00\">"));
  EXPECT_TRUE(html.ends_with("</script>\n"));
  const Unpacked unpacked(html, "digits-00");
  EXPECT_EQ(unpacked.header.at("words"),
            (nlohmann::json{{"names", {"latent 1", "é <&>"}}, {"replication", 3}}));
  EXPECT_EQ(unpacked.header.at("arrays").at(0).at("shape"), nlohmann::json({10, 10, 10}));
  EXPECT_EQ(unpacked.read<std::uint8_t>("image"), image);
  EXPECT_EQ(unpacked.read<std::uint16_t>("way"), way);
  EXPECT_EQ(unpacked.read<std::int32_t>("id"), id);
  EXPECT_EQ(unpacked.read<float>("none"), std::vector<float>{});
  const std::vector<float> back = unpacked.read<float>("place");
  ASSERT_EQ(back.size(), place.size());
  EXPECT_EQ(std::memcmp(back.data(), place.data(), 4 * place.size()), 0);  // -0 and subnormals, too
  EXPECT_EQ(unpacked.size(), 1000u + 2 * 1000 + 4 * 1000 + 4 * 1006);
}

// What changes little from value to value, or from row to row, is kept as differences; what does not, is not.
TEST(Pack, TakesTheDifferencesThatDeflateBest) {
  std::vector<std::int32_t> steps, rows;
  std::vector<std::uint8_t> zeros(4000, 0);
  Rng rng(Seed(2));
  for (int i = 0; i < 4000; ++i) {
    steps.push_back((i > 0 ? steps.back() : 0) + 1000 + static_cast<int>(rng.below(8)));
    rows.push_back(i < 40 ? static_cast<std::int32_t>(rng.below(4000000000u)) : rows[i - 40] + 70000);
  }
  const auto pack_of = [&] {
    Pack pack("p");
    pack.array("steps", {4000}, steps);
    pack.array("rows", {100, 40}, rows);
    pack.array("zeros", {4000}, zeros);
    return pack.html();
  };
  const std::string html = pack_of();
  EXPECT_EQ(html, pack_of());
  const Unpacked unpacked(html, "p");
  EXPECT_EQ(unpacked.delta("steps"), 1u);
  EXPECT_EQ(unpacked.delta("rows"), 40u);
  EXPECT_EQ(unpacked.delta("zeros"), 0u);
  EXPECT_EQ(unpacked.read<std::int32_t>("steps"), steps);
  EXPECT_EQ(unpacked.read<std::int32_t>("rows"), rows);
  EXPECT_LT(html.size(), 4000u);  // of 36 000 bytes
}

TEST(Pack, RefusesWhatCannotBeRead) {
  EXPECT_THAT([] { Pack pack("a b"); }, ThrowsMessage<InputError>(HasSubstr("pack 'a b'")));
  Pack pack("p");
  pack.array("x", {2}, std::vector<float>{1, 2});
  EXPECT_THAT([&] { pack.array("x", {1}, std::vector<float>{1}); },
              ThrowsMessage<InputError>(HasSubstr("'x' stands twice")));
  EXPECT_THAT(
      [&] {
        pack.array("y", {2, 3}, std::vector<float>{1});
      },
      ThrowsMessage<InputError>(HasSubstr("'y' has 1 values; its shape asks for 6")));
}

}  // namespace
}  // namespace hbr
