// Why digits are good, and which are rare: the turns of their strokes, and the classes that the network
// confuses.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/figures/contender.h"
#include "reports/figures/figures.h"
#include "reports/figures/panels.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

struct Estimate {
  double value, low, high;
};

std::optional<Estimate> estimate(const StatisticsView& statistics, const std::string& name) {
  const auto value = statistics.number(name), low = statistics.number(name + "_low"),
             high = statistics.number(name + "_high");
  if (!value || !low || !high) return {};
  return Estimate{*value, *low, *high};
}

std::string in_words(const Estimate& e, double scale = 1) {
  return fmt::format("{} [{}; {}]", format_number(e.value * scale, 2), format_number(e.low * scale, 2),
                     format_number(e.high * scale, 2));
}

// Which of three it is, by the interval: above `none`, below it, or not told apart from it.
const char* by_sign(const Estimate& e, double none, const char* above, const char* below,
                    const char* neither) {
  return e.low > none ? above : e.high < none ? below : neither;
}

// What the angles say, each part by its interval.
std::string turns_in_words(const StatisticsView& statistics) {
  const auto flat = estimate(statistics, "digit_turns.flat_turn_more"),
             hbr_refused = estimate(statistics, "digit_turns.hbr.refused_turn_more"),
             flat_refused = estimate(statistics, "digit_turns.flat.refused_turn_more");
  if (!flat || !hbr_refused || !flat_refused) return "";
  const char *more = "turn more sharply than", *less = "turn less sharply than",
             *alike = "turn about as sharply as";
  const auto tells = [](const Estimate& e) { return e.low > 0.5 || e.high < 0.5; };
  std::string what;  // it goes with
  if (tells(*flat)) what = "who drew it";
  if (tells(*hbr_refused) || tells(*flat_refused))
    what += fmt::format("{}what the judge says of it{}", what.empty() ? "" : " and with ",
                        !tells(*flat_refused)  ? ", within the hierarchy"
                        : !tells(*hbr_refused) ? ", within the flat search"
                                               : "");
  std::string curvature;
  if (const auto test = statistics.test("digit_turns.flat.curvature", "digit_turns.hbr.curvature");
      test && test->p)
    curvature = fmt::format(" On a way as long as the side of their box {} (p = {}).",
                            *test->p >= 0.05  ? "the two are not told apart"
                            : test->a12 > 0.5 ? "flat digits turn more, too"
                                              : "flat digits turn less",
                            format_p(*test->p));
  return fmt::format(
      "<p>Flat digits {} those of the hierarchy (A<sub>12</sub> {}). Refused digits of the hierarchy {} its "
      "good ones ({}), refused flat digits {} good flat ones ({}).{} {}</p>\n",
      by_sign(*flat, 0.5, more, less, alike), in_words(*flat), by_sign(*hbr_refused, 0.5, more, less, alike),
      in_words(*hbr_refused), by_sign(*flat_refused, 0.5, more, less, alike), in_words(*flat_refused),
      curvature,
      what.empty() ? "So in this run the angles tell neither who drew a digit nor whether it is good."
                   : fmt::format("So how sharply a digit turns goes with {}; an A<sub>12</sub> near 0.5 "
                                 "means that most of it depends on something else.",
                                 what));
}

std::string confusion_in_words(const StatisticsView& statistics) {
  std::string text;
  for (const auto& [measure, what] :
       {std::pair{"good_if_confused", "classes that the network confuses with others"},
        std::pair{"good_if_cut", "classes of which the cut removed many images"}})
    for (const auto& [who, where] : {std::pair{"hbr", "the hierarchy"}, std::pair{"flat", "the flat search"}})
      if (const auto e = estimate(statistics, fmt::format("digit_verdicts.{}.{}", who, measure)))
        text += fmt::format("With {} {} {} (rank correlation {}). ", where, what,
                            by_sign(*e, 0, "are more frequent", "are rarer",
                                    "are neither rarer nor more frequent by what ten classes can tell"),
                            in_words(*e));
  return text.empty() ? "" : "<p>" + text + "</p>\n";
}

// One bar for each class: the median over the replications, in per cent; empty where it was not measured.
template <class Name>
std::vector<double> by_class(const StatisticsView& statistics, Name&& name, double scale, double from = 0) {
  std::vector<double> bars;
  for (int c = 0; c < 10; ++c) {
    const std::vector<double> values = statistics.quantity(name(c));
    if (values.empty()) return {};
    bars.push_back(from + scale * summarise(values, "of a class").median);
  }
  return bars;
}

// Per cent of all good digits.
std::vector<double> shares(std::vector<double> counts) {
  double all = 0;
  for (const double count : counts) all += count;
  for (double& count : counts) count = all > 0 ? 100 * count / all : 0;
  return counts;
}

}  // namespace

Figure turns_figure(const Evidence& evidence) {
  Figure figure{.id = "turns", .title = "Arcs or abrupt angles"};
  figure.caption =
      "By how much strokes turn from one segment to the next, without the sense. a: all digits of all "
      "replications, each by its mean turn, those that the judge calls good and those that it does not. b: "
      "the mean of all turns; of the hierarchy within its arcs and where one arc ends and the next begins. "
      "c: what a digit turns on a way as long as the greater side of its box. b and c: one value per "
      "replication. A segment is a line of layer 2, or the way between two configurations. A<sub>12</sub>: "
      "the chance that a value of "
      "the first kind is greater than one of the second. Brackets: 95 % intervals by bootstrap over the "
      "replications.";
  figure.panels = pooled_box_panel(evidence.statistics,
                                   {"digit_turns.hbr.of_good", "digit_turns.hbr.of_refused",
                                    "digit_turns.flat.of_good", "digit_turns.flat.of_refused"},
                                   {.title = "Mean turn of a digit",
                                    .unit = "degrees",
                                    .figure = figure.id,
                                    .from_zero = true,
                                    .brackets = false},
                                   figure.tables);
  for (const auto& [title, names] :
       {std::pair{"Mean turn", std::vector<std::string>{"digit_turns.hbr.within", "digit_turns.hbr.joints",
                                                        "digit_turns.flat.within"}},
        std::pair{"Curvature",
                  std::vector<std::string>{"digit_turns.hbr.curvature", "digit_turns.flat.curvature"}}})
    for (Panel& panel : box_panel(evidence.statistics, names,
                                  {.title = title, .unit = "degrees", .figure = figure.id, .from_zero = true},
                                  figure.tables))
      figure.panels.push_back(std::move(panel));
  figure.notes = turns_in_words(evidence.statistics);
  if (figure.panels.empty())
    figure.absent =
        "This run did not compare how the strokes of the hierarchy’s digits and of flat ones turn.";
  return figure;
}

Figure confusion_figure(const Evidence& evidence) {
  Figure figure{.id = "confusion", .title = "Rare classes, confused classes"};
  figure.caption =
      "For each class: its share of the digits that the judge calls good, with the hierarchy and without; of "
      "its test images those whose nearest neighbour in the latent space is of another class; and of its "
      "training images those that the cut removed. Medians over the replications. The correlations are over "
      "the ten classes, each by its mean over the replications; their 95 % intervals by bootstrap over the "
      "classes.";
  const StatisticsView& statistics = evidence.statistics;
  const auto good_of = [](const char* who) {
    return [who](int c) { return fmt::format("digit_verdicts.{}.good_of_class.{}", who, c); };
  };
  const auto of_network = [](const char* measure) {
    return [measure](int c) { return fmt::format("autoencoder.{}.{}", measure, c); };
  };
  BarPlot bars{.unit = "%", .x_label = "class", .groups = {}, .series = {}, .width = 1000};
  for (int c = 0; c < 10; ++c) bars.groups.push_back(std::to_string(c));
  for (const BarSeries& series :
       {BarSeries{"good, HBR", Colour::blue, shares(by_class(statistics, good_of("hbr"), 1))},
        BarSeries{"good, flat", Colour::vermilion, shares(by_class(statistics, good_of("flat"), 1))},
        BarSeries{"confused", Colour::purple, by_class(statistics, of_network("confused_of_class"), 100)},
        BarSeries{"cut", Colour::grey, by_class(statistics, of_network("kept_of_class"), -100, 100)}}) {
    if (series.values.empty()) continue;
    for (std::size_t c = 0; c < series.values.size(); ++c)
      figure.tables["classes"].add(
          {{"series", series.label}, {"class", static_cast<double>(c)}, {"per_cent", series.values[c]}});
    bars.series.push_back(series);
  }
  if (statistics.quantities("autoencoder.confused_of_class.").empty()) {
    figure.absent = "This run has no autoencoder, so it does not show which classes one confuses.";
    return figure;
  }
  figure.panels.push_back({"Classes", plot_script(bars, "confusion-classes"), 6});
  figure.notes = confusion_in_words(statistics);
  std::vector<std::string> pairs;
  for (int c = 0; c < 10; ++c)
    if (const auto other = statistics.number(fmt::format("autoencoder.taken_for.{}", c)))
      pairs.push_back(fmt::format("{} for {}", c, *other));
  if (!pairs.empty())
    figure.notes += fmt::format("<p>The network takes most often {}.</p>\n", fmt::join(pairs, ", "));
  return figure;
}

}  // namespace hbr::inline reports
