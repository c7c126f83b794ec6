#include "reports/text/template.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TemplateContent content() {
  TemplateContent c;
  c.values = {{"profile", "reduced"}};
  c.figures = {{"digits", "<figure></figure>"}};
  c.statistics = nlohmann::json::parse(R"({
    "quantities": {
      "layer2.n10.size": {"unit": "elites", "n": 3, "median": 1397, "q1": 1335, "q3": 1520, "min": 1300, "max": 1600},
      "digit_verdicts.hbr.good": {"unit": "", "n": 3, "median": 0.6, "q1": 0.55, "q3": 0.65, "min": 0.5, "max": 0.7},
      "accuracy.n1": {"unit": "m^2", "n": 3, "median": 2.7e-4, "q1": 2.6e-4, "q3": 2.8e-4, "min": 1e-4, "max": 3e-4}},
    "numbers": {"transfer.nao.absolute_median": {"unit": "%", "value": 0.916}},
    "tests": {"accuracy.n1_vs_accuracy.n10": {"n_a": 50, "n_b": 50, "p": 7.066e-18, "a12": 1, "ratio": 3.88},
              "accuracy.n1_vs_layer2.n10.size": {"n_a": 2, "n_b": 3, "p": 0.2}}})");
  return c;
}

std::string fill(const std::string& text) {
  return fill_template(text + "{{value:profile}}{{figure:digits}}", content());
}
const std::string kRest = "reduced<figure></figure>";

void expect_error(const std::string& text, const std::string& message) {
  EXPECT_THAT([&] { fill(text); }, ThrowsMessage<InputError>(HasSubstr(message))) << text;
}

TEST(Template, FillsInNumbers) {
  EXPECT_EQ(fill("{{stat:layer2.n10.size}} "), "1\u202f397 [1\u202f335; 1\u202f520] " + kRest);
  EXPECT_EQ(fill("{{stat:layer2.n10.size:n}} "), "3 " + kRest);
  EXPECT_EQ(fill("{{stat:accuracy.n1:median}} "), "2.70·10⁻⁴\u202fm² " + kRest);
  EXPECT_EQ(fill("{{stat:digit_verdicts.hbr.good:percent}} "), "60 [55; 65]\u202f% " + kRest);
  EXPECT_EQ(fill("{{stat:digit_verdicts.hbr.good:share}} "), "60\u202f% " + kRest);
  EXPECT_EQ(fill("{{number:transfer.nao.absolute_median}} "), "0.916\u202f% " + kRest);
  EXPECT_EQ(fill("{{test:accuracy.n1_vs_accuracy.n10:p}} {{test:accuracy.n1_vs_accuracy.n10:ratio}} "),
            "p = 7.1·10⁻¹⁸ 3.88 " + kRest);
  EXPECT_EQ(fill("{{test:accuracy.n1_vs_layer2.n10.size:p}} "), "too few replications for a test " + kRest);
}

TEST(Template, TakesTheBranchThatIsMeasured) {
  EXPECT_EQ(fill("{{if stat:accuracy.n1}}{{stat:accuracy.n1:n}}{{else}}none{{end}} "), "3 " + kRest);
  EXPECT_EQ(fill("{{if stat:accuracy.n1 stat:accuracy.n100}}{{stat:accuracy.n100}}{{else}}none{{end}} "),
            "none " + kRest);
  EXPECT_EQ(fill("{{if test:accuracy.n1_vs_accuracy.n100}}x{{end}}y "), "y " + kRest);
}

TEST(Template, RefusesWhatNothingFills) {
  expect_error("\n{{value:prifile}}", "line 2 for 'value:prifile'");
  expect_error("{{figure:nothing}}", "'figure:nothing'");
  expect_error("{{stat:layer2.n11.size}}", "'stat:layer2.n11.size'");
  expect_error("{{stat:layer2.n10.size:meadian}}", "'stat:layer2.n10.size:meadian'");
  expect_error("{{profile}}", "'profile'");
  expect_error("{{test:accuracy.n1:p}}", "'test:accuracy.n1:p'");
  expect_error("{{number:transfer.nao.absolute_median:share}}", "absolute_median:share'");
  // A slip in a condition is no absence.
  expect_error("{{if stat:layer2.n10.sice}}x{{end}}", "which no profile measures");
  expect_error("{{if value:profile}}x{{end}}", "expected stat:NAME");
}

TEST(Template, RefusesWhatHasNoPlace) {
  TemplateContent c = content();
  EXPECT_THAT([&] { fill_template("{{value:profile}}", c); },
              ThrowsMessage<InputError>(HasSubstr("no place for: figure:digits")));
  EXPECT_THAT([&] { fill_template("{{figure:digits}}", c); },
              ThrowsMessage<InputError>(HasSubstr("no place for: value:profile")));
  // A place in the branch that is not taken is a place.
  EXPECT_EQ(fill_template("{{if stat:accuracy.n100}}{{value:profile}}{{else}}-{{end}}{{figure:digits}}", c),
            "-<figure></figure>");
}

TEST(Template, RefusesBrokenMarkup) {
  expect_error("{{if stat:accuracy.n1}}x", "without {{end}}");
  expect_error("{{if stat:accuracy.n100}}x", "{{if}} without end in line 1");
  expect_error("x{{end}}", "{{end}} without if");
  expect_error("x{{else}}", "{{else}} without if");
  expect_error("{{if stat:accuracy.n1}}{{if stat:accuracy.n1}}{{end}}{{end}}", "nests");
  EXPECT_THAT([&] { fill_template("a\nb {{value:profile", content()); },
              ThrowsMessage<InputError>(HasSubstr("unclosed {{ in line 2")));
}

TEST(Template, LeavesTheRestAlone) { EXPECT_EQ(fill("a { b } }} c "), "a { b } }} c " + kRest); }

}  // namespace
}  // namespace hbr
