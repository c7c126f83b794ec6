#include "reports/plot/svg.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <sstream>

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

// The contrast of a colour "#rrggbb" with white, as WCAG 2 defines it: 1 for white itself, 21 for black.
double contrast_with_white(const std::string& colour) {
  const std::array<double, 3> weights = {0.2126, 0.7152, 0.0722};
  double luminance = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double level = std::stoi(colour.substr(1 + 2 * i, 2), nullptr, 16) / 255.0;
    luminance += weights[i] * (level <= 0.04045 ? level / 12.92 : std::pow((level + 0.055) / 1.055, 2.4));
  }
  return 1.05 / (luminance + 0.05);
}

// Of lines and areas colours can be lighter than of words.
TEST(Svg, WordsAreDarkEnoughToBeRead) {
  EXPECT_NEAR(contrast_with_white("#000000"), 21, 1e-9);
  EXPECT_NEAR(contrast_with_white("#767676"), 4.54, 0.005);
  EXPECT_EQ(hex_of_words(Colour::blue), hex(Colour::blue));
  for (const Colour colour : {Colour::ink, Colour::blue, Colour::orange, Colour::green, Colour::vermilion,
                              Colour::purple, Colour::sky, Colour::grey}) {
    const std::string words = hex_of_words(colour);
    EXPECT_GE(contrast_with_white(recolour_for_paper(words)), 4.5) << words;
    EXPECT_THAT(recolour_for_page(words), testing::MatchesRegex("var\\(--[a-z]+(-words)?\\)"));
  }
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

TEST(Plot, WordsArriveAsTheyAre) {
  const Drawing d = draw({plot_script(
      BoxPlot{.unit = "`echo a` %", .boxes = {{"50 % `echo b`", Colour::blue, box({1, 2, 3}, "values"), {}}}},
      "p")})[0];
  EXPECT_THAT(d.body, HasSubstr(">`echo a` %<"));
  EXPECT_THAT(d.body, HasSubstr(">50 % `echo b`<"));
}

// What has no logarithm stands at the foot of the axis.
TEST(Plot, LogarithmicAxesHoldAllNumbers) {
  const std::string text =
      plot_script(BoxPlot{.unit = "m",
                          .boxes = {{"a", Colour::blue, box({0, 0, 0}, "values"), {0, 0, 0}},
                                    {"b", Colour::blue, box({1, 2, 3}, "values"), {}}},
                          .brackets = {},
                          .logarithmic = true},
                  "p")
          .text;
  for (const std::string block : {"$b0 << END\n", "$p0 << END\n"}) {
    const std::size_t begin = text.find(block);
    ASSERT_NE(begin, std::string::npos) << text;
    std::istringstream rows(text.substr(begin + block.size()));
    int numbers = 0;
    for (double number; rows >> number; ++numbers) EXPECT_GT(number, 0) << block;
    EXPECT_EQ(numbers, 6) << block;
  }
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
