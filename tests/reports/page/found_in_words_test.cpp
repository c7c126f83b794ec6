// Sentences of figures that say what was found: their words follow the numbers.
#include <gmock/gmock.h>

#include "reports/figures/figures.h"

namespace hbr {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

void put(json& statistics, const std::string& name, double value, double low, double high) {
  for (const auto& [end, number] : {std::pair{"", value}, {"_low", low}, {"_high", high}})
    statistics["numbers"][name + end] = {{"unit", ""}, {"meaning", ""}, {"value", number}};
}

std::string notes_of_turns(double flat, double hbr_refused, double flat_refused) {
  json statistics = {{"numbers", json::object()}, {"quantities", json::object()}};
  put(statistics, "digit_turns.flat_turn_more", flat, flat - 0.05, flat + 0.05);
  put(statistics, "digit_turns.hbr.refused_turn_more", hbr_refused, hbr_refused - 0.05, hbr_refused + 0.05);
  put(statistics, "digit_turns.flat.refused_turn_more", flat_refused, flat_refused - 0.05,
      flat_refused + 0.05);
  return turns_figure({Artifacts({}), StatisticsView(statistics)}).notes;
}

TEST(FoundInWords, TurnsByTheirIntervals) {
  EXPECT_THAT(
      notes_of_turns(0.9, 0.6, 0.52),
      AllOf(HasSubstr("Flat digits turn more sharply than those"), HasSubstr("0.90 [0.85; 0.95]"),
            HasSubstr("of the hierarchy turn more sharply than its good ones"),
            HasSubstr("refused flat digits turn about as sharply as good flat ones"),
            HasSubstr("goes with who drew it and with what the judge says of it, within the hierarchy;")));
  EXPECT_THAT(notes_of_turns(0.3, 0.4, 0.6),
              AllOf(HasSubstr("Flat digits turn less sharply than those"),
                    HasSubstr("of the hierarchy turn less sharply than its good ones"),
                    HasSubstr("refused flat digits turn more sharply than good flat ones")));
  EXPECT_THAT(notes_of_turns(0.9, 0.7, 0.3),
              HasSubstr("with who drew it and with what the judge says of it;"));
  EXPECT_THAT(notes_of_turns(0.9, 0.52, 0.48), HasSubstr("goes with who drew it;"));
  EXPECT_THAT(notes_of_turns(0.5, 0.5, 0.7),
              HasSubstr("with what the judge says of it, within the flat search;"));
  EXPECT_THAT(notes_of_turns(0.5, 0.7, 0.7),
              AllOf(HasSubstr("Flat digits turn about as sharply"), Not(HasSubstr("goes with who drew it"))));
  EXPECT_THAT(notes_of_turns(0.5, 0.5, 0.5),
              HasSubstr("tell neither who drew a digit nor whether it is good"));
}

TEST(FoundInWords, RareClassesByTheirIntervals) {
  const auto notes = [](double hbr, double flat) {
    json statistics = {{"numbers", json::object()}, {"quantities", json::object()}};
    for (int c = 0; c < 10; ++c)
      statistics["quantities"]["autoencoder.confused_of_class." + std::to_string(c)] = {
          {"unit", ""}, {"meaning", ""}, {"values", {0.1 * c}}};
    put(statistics, "digit_verdicts.hbr.good_if_confused", hbr, hbr - 0.2, hbr + 0.2);
    put(statistics, "digit_verdicts.flat.good_if_confused", flat, flat - 0.2, flat + 0.2);
    statistics["numbers"]["autoencoder.taken_for.4"] = {{"unit", ""}, {"meaning", ""}, {"value", 9}};
    return confusion_figure({Artifacts({}), StatisticsView(statistics)}).notes;
  };
  EXPECT_THAT(notes(-0.7, 0.1), AllOf(HasSubstr("With the hierarchy classes that the network confuses with "
                                                "others are rarer (rank correlation \u22120.7"),
                                      HasSubstr("With the flat search classes that the network confuses with "
                                                "others are neither rarer nor more frequent"),
                                      HasSubstr("4 for 9")));
  EXPECT_THAT(notes(0.7, 0.7), HasSubstr("are more frequent"));
}

TEST(FoundInWords, ReplacementsByTheirTest) {
  const auto notes = [](double p, double a12) {
    json statistics = {{"numbers", json::object()}, {"quantities", json::object()}};
    for (const char* layer : {"n1", "n10", "n100"})
      for (const auto& [measure, value] :
           {std::pair{"replaced", 0.25}, {"late_gain", 0.0625}, {"fresh_mean", -1.0}})
        statistics["quantities"][std::string("layer3.") + layer + "." + measure] = {
            {"unit", ""}, {"meaning", ""}, {"values", {value, value, value}}};
    statistics["tests"]["layer3.n100.replaced_vs_layer3.n10.replaced"] = {{"a", "layer3.n100.replaced"},
                                                                          {"b", "layer3.n10.replaced"},
                                                                          {"n_a", 3},
                                                                          {"n_b", 3},
                                                                          {"p", p},
                                                                          {"a12", a12}};
    return arc_quality_figure({Artifacts({}), StatisticsView(statistics)}).notes;
  };
  EXPECT_THAT(notes(0.01, 0.1), AllOf(HasSubstr("25 % (1 sample), 25 % (10), 25 % (100)"),
                                      HasSubstr("With 100 samples fewer are replaced")));
  EXPECT_THAT(notes(0.01, 0.9), HasSubstr("With 100 samples more are replaced"));
  EXPECT_THAT(notes(0.2, 0.9), HasSubstr("this run does not tell"));
}

}  // namespace
}  // namespace hbr
