#include "reports/claims/sensitivity.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

json claim(const std::string& id, const std::string& verdict, const std::string& indication,
           const std::vector<std::pair<double, std::string>>& checks) {
  json list = json::array();
  for (const auto& [x, figure] : checks) list.push_back({{"x", x}, {"figure", figure}});
  list.push_back({{"outcome", "absent"}});  // one that could not be made
  return {{"id", id},           {"statement", "About <" + id + ">"}, {"place", "5.4"},
          {"verdict", verdict}, {"indication", indication},          {"checks", list}};
}

json claims(const std::string& verdict, double x) {
  return json::array(
      {claim("ratio", "not at this size", verdict, {{x, fmt::format("{} times", x)}, {3, "3 times"}}),
       claim("steady", "reproduced", "reproduced", {{x, fmt::format("{}", x)}}),
       claim("digits", "not at this size", "", {})});
}

const std::vector<VariationClaims> kVariations = {{"short", "Shorter & shorter.", claims("not", 1.5)},
                                                  {"same", "Nothing here.", claims("partly", 2.5)}};

TEST(Sensitivity, RowsAreWhatVariationsAnswer) {
  const json table = sensitivity_table(claims("partly", 2.5), kVariations);
  ASSERT_EQ(table["rows"].size(), 2u);  // no digits anywhere
  const json& row = table["rows"][0];
  EXPECT_EQ(row["id"], "ratio");
  EXPECT_EQ(row["moves"], true);
  ASSERT_EQ(row["cells"].size(), 3u);
  EXPECT_EQ(row["cells"][0], (json{{"verdict", "partly"},
                                   {"decided", false},
                                   {"figures", {"2.5 times", "3 times"}},
                                   {"x", {2.5, 3.0}}}));
  EXPECT_EQ(row["cells"][1]["verdict"], "not");
  EXPECT_EQ(row["cells"][2], row["cells"][0]);
  EXPECT_EQ(table["rows"][1]["moves"], false);
  EXPECT_EQ(table["rows"][1]["cells"][1]["decided"], true);
  EXPECT_EQ(table["variations"][1], (json{{"name", "same"}, {"changes", "Nothing here."}}));
}

TEST(Sensitivity, AClaimThatOnlyAVariationAnswersHasARow) {
  json base = claims("partly", 2.5);
  base[0]["indication"] = "";
  base[0]["checks"] = json::array({{{"outcome", "absent"}}});
  const json row = sensitivity_table(base, kVariations)["rows"][0];
  EXPECT_EQ(row["cells"][0]["verdict"], "");
  EXPECT_EQ(row["moves"], true);
  EXPECT_THAT(sensitivity_html(sensitivity_table(base, kVariations)),
              HasSubstr("<td data-name=\"This run\">–</td>"));
}

TEST(Sensitivity, ThePageMarksWhatMoves) {
  const std::string html = sensitivity_html(sensitivity_table(claims("partly", 2.5), kVariations));
  EXPECT_THAT(html, HasSubstr("Of the 2 claims that a variation answers 1 moves."));
  EXPECT_THAT(html, HasSubstr("<dt><code>short</code></dt><dd>Shorter &amp; shorter.</dd>"));
  EXPECT_THAT(html, HasSubstr("<tr class=\"moves\"><th scope=\"row\">About &lt;ratio&gt;"));
  EXPECT_THAT(html, HasSubstr("<tr><th scope=\"row\">About &lt;steady&gt;"));
  EXPECT_THAT(html, HasSubstr("<td data-name=\"short\" class=\"moved\"><span class=\"badge not\">✗ "
                              "not</span><br>1.5 · 3 times</td>"));
  EXPECT_THAT(html, HasSubstr("<td data-name=\"same\" class=\"same\">as run</td>"));
  EXPECT_THAT(html, Not(HasSubstr("digits")));
}

TEST(Sensitivity, WithoutVariationsThereIsNoSection) {
  EXPECT_EQ(sensitivity_html(sensitivity_table(claims("partly", 1), {})), "");
}

TEST(Sensitivity, OtherClaimsAreRefused) {
  std::vector<VariationClaims> wrong = kVariations;
  wrong[1].claims.erase(2);
  EXPECT_THROW(sensitivity_table(claims("partly", 1), wrong), InputError);
  wrong[1].claims = claims("not", 1);
  wrong[1].claims[1]["id"] = "other";
  EXPECT_THROW(sensitivity_table(claims("partly", 1), wrong), InputError);
}

}  // namespace
}  // namespace hbr
