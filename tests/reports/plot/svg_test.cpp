#include "reports/plot/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/core/check.h"
#include "reports/plot/colour.h"
#include "reports/plot/plot.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::ThrowsMessage;

TEST(Svg, PrefixesIdsAndWhatRefersToThem) {
  const Drawing d = parse_svg(
      "<?xml?><svg viewBox='0 0 40 30'><title>Gnuplot</title><g id='a'/><use xlink:href='#a'/><rect "
      "fill=\"url(#g)\" id = \"b\"/></svg>",
      "p");
  EXPECT_EQ(d.width, 40);
  EXPECT_EQ(d.height, 30);
  EXPECT_EQ(d.body, "<g id='p-a'/><use xlink:href='#p-a'/><rect fill=\"url(#p-g)\" id=\"p-b\"/>");
}

TEST(Svg, RefusesWhatIsNone) {
  EXPECT_THAT([] { parse_svg("<html></html>", "p"); },
              ThrowsMessage<InputError>(HasSubstr("drawing p is no SVG")));
}

TEST(Svg, ColoursFollowThePage) {
  const std::string svg = "stroke='rgb(  0, 114, 178)' fill=\"#010203\" fill='rgb(9,9,9)' #12 rgb(x";
  EXPECT_EQ(recolour_for_page(svg), "stroke='var(--blue)' fill=\"var(--ink)\" fill='rgb(9,9,9)' #12 rgb(x");
  EXPECT_THAT(recolour_for_paper(svg), HasSubstr("stroke='#0072b2' fill=\"#22262b\""));
}

TEST(Plot, TwoPlotsShareNoId) {
  const auto plot = [](const char* prefix) {
    return plot_script(
        BoxPlot{.unit = "m²",
                .boxes = {{"a\nb", Colour::blue, box({1, 2, 3, 4, 50}, "values"), {1, 2, 3, 4, 50}},
                          {"\"c\" \\d", Colour::orange, box({2, 3, 4}, "values"), {}}},
                .brackets = {{0, 1, "p = 0.10"}}},
        prefix);
  };
  const std::vector<Drawing> drawings = draw({plot("one"), plot("two"), plot("one")});
  const std::string one = drawings[0].body;
  EXPECT_THAT(one, HasSubstr("id='one-gpDot'"));
  EXPECT_THAT(one, HasSubstr("p = 0.10"));
  EXPECT_THAT(one, HasSubstr("\"c\" \\d"));
  EXPECT_THAT(one, Not(HasSubstr("Gnuplot")));
  EXPECT_THAT(drawings[1].body, Not(HasSubstr("one-")));
  // Nothing of one plot is left for the next.
  EXPECT_EQ(drawings[2].body, one);
  EXPECT_EQ(draw({plot("one")})[0].body, one);
}

// gnuplot only draws: a box's edges stand where its quartiles are.
TEST(Plot, AxisTakesOutPowersOfTen) {
  const Drawing d = draw({plot_script(
      BandPlot{.x_label = "generation",
               .unit = "m²",
               .bands = {{"n", Colour::blue, {0, 10}, {1e-4, 2e-4}, {1e-4, 2e-4}, {1e-4, 2e-4}}}},
      "p")})[0];
  EXPECT_THAT(d.body, HasSubstr("10⁻⁴ m²"));
  EXPECT_EQ(d.width, 400);
}

TEST(Plot, NothingButZerosCanBeDrawn) {
  for (const bool from_zero : {true, false})
    EXPECT_NO_THROW(
        draw({plot_script(BoxPlot{.unit = "%",
                                  .boxes = {{"a", Colour::blue, box({0, 0, 0}, "values"), {0, 0, 0}}},
                                  .brackets = {},
                                  .from_zero = from_zero},
                          "p")}));
}

}  // namespace
}  // namespace hbr
