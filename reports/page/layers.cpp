#include "reports/page/layers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <map>
#include <regex>
#include <set>

#include "pipeline/artifact/unit_columns.h"
#include "pipeline/statistics/names.h"
#include "pipeline/statistics/summary.h"
#include "reports/plot/picture.h"
#include "reports/text/format.h"
#include "reports/text/html.h"

namespace hbr::inline reports {
namespace {

constexpr double kStackWidth = 316, kFlatLeft = 334, kFlatWidth = 108, kBox = 42, kStep = 68;
constexpr const char* kNothing = "nothing";  // stands on a flat layer

// The lowest layer first.
std::vector<LayerOfProfile> longest_stack(const std::vector<LayerOfProfile>& layers) {
  std::map<std::string, std::vector<LayerOfProfile>> stacks;
  std::vector<LayerOfProfile> longest;
  for (const LayerOfProfile& layer : layers) {
    std::vector<LayerOfProfile> stack = stacks[layer.below];
    stack.push_back(layer);
    stacks[layer.name] = stack;
    if (stack.size() > longest.size()) longest = stack;
  }
  return longest;
}

std::string box(double x, double y, double width, const std::string& name, const std::string& meaning,
                Colour colour) {
  return fmt::format(
             "<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"8\" fill=\"none\" stroke=\"{}\" "
             "stroke-width=\"1.5\"/>\n",
             x + 1, y + 1, width - 2, kBox - 2, hex(colour)) +
         svg_text(name, x + 12, y + (meaning.empty() ? 26 : 18), 14, colour, Align::left) +
         (meaning.empty() ? "" : svg_text(meaning, x + 12, y + 35, 13, Colour::ink, Align::left));
}

// A command on its way down.
std::string arrow(double x, double from, double to, const std::string& what) {
  return fmt::format(
             "<path d=\"M{0} {1}V{2}m-5 -7l5 7l5 -7\" fill=\"none\" stroke=\"{3}\" stroke-width=\"1.5\"/>\n",
             x, from + 2, to - 2, hex(Colour::grey)) +
         svg_text(what, x + 10, (from + to) / 2 + 4, 13, Colour::grey, Align::left);
}

std::string squares(const std::string& text) { return std::regex_replace(text, std::regex("\\^2"), "²"); }

// "place x, place y (m)"; each with its own unit where they differ.
std::string in_words(const UnitColumns& columns) {
  const bool alike = std::ranges::all_of(columns.units, [&](const auto& u) { return u == columns.units[0]; });
  const auto with_unit = [](const std::string& what, const std::string& unit) {
    return unit.empty() ? what : fmt::format("{} ({})", what, squares(unit));
  };
  std::vector<std::string> names;
  for (std::size_t c = 0; c < columns.names.size(); ++c)
    names.push_back(alike ? columns.names[c] : with_unit(columns.names[c], columns.units[c]));
  const std::string all = fmt::format("{}", fmt::join(names, ", "));
  return escape_html(alike && !names.empty() ? with_unit(all, columns.units[0]) : all);
}

}  // namespace

std::string hierarchy_diagram(const std::vector<LayerOfProfile>& layers) {
  const std::vector<LayerOfProfile> stack = longest_stack(layers);
  if (stack.empty()) return "";
  const auto n = static_cast<double>(stack.size());
  const auto top_of = [&](double rank) { return (n - 1 - rank) * kStep; };
  const double joints = n * kStep;
  std::string body = box(0, joints, kFlatLeft + kFlatWidth, "joints of the planar arm, or of another robot",
                         "", Colour::ink),
              words;
  for (std::size_t i = 0; i < stack.size(); ++i) {
    const double top = top_of(static_cast<double>(i));
    const std::string what = stack[i].below.empty() ? "joint angles" : stack[i].asks;
    body += box(0, top, kStackWidth, stack[i].name, stack[i].meaning, Colour::blue);
    body += arrow(28, top + kBox, top + kStep, what);
    words = fmt::format("{} commands {} by {}. {}", stack[i].name,
                        stack[i].below.empty() ? "the joints" : stack[i].below, what, words);
  }
  // Beside them, the lower the narrower, so that each has its way down.
  std::vector<std::pair<std::ptrdiff_t, LayerOfProfile>> flat;
  for (const LayerOfProfile& layer : layers) {
    if (layer.answers != kNothing) continue;
    const auto peer = std::ranges::find_if(
        stack, [&](const LayerOfProfile& other) { return layer.kind.ends_with(other.kind); });
    flat.emplace_back(std::min<std::ptrdiff_t>(peer - stack.begin(), std::ssize(stack) - 1), layer);
  }
  std::ranges::stable_sort(flat, std::greater<>(), &std::pair<std::ptrdiff_t, LayerOfProfile>::first);
  for (std::size_t i = 0; i < flat.size(); ++i) {
    const double top = top_of(static_cast<double>(flat[i].first)),
                 width = kFlatWidth - 16.0 * static_cast<double>(i);
    body += box(kFlatLeft, top, width, flat[i].second.name, "", Colour::vermilion);
    body += arrow(kFlatLeft + width - 8, top + kBox, joints, "");
    words += fmt::format("{} commands the joints directly. ", flat[i].second.name);
  }
  words.pop_back();
  return inline_svg({kFlatLeft + kFlatWidth, joints + kBox, body, words}, "hierarchy",
                    "The hierarchy of layers");
}

std::string layers_table(const std::vector<LayerOfProfile>& layers, const Evidence& evidence) {
  std::set<std::string> names;
  for (const LayerOfProfile& layer : layers) names.insert(layer.name);
  std::vector<std::vector<std::string>> rows;
  std::map<std::string, std::string> told;  // descriptor and fitness -> the first layer that has them
  for (const LayerOfProfile& layer : layers) {
    const std::string statistic = parse_artifact_name(layer.name + "/00.h5", names).prefix();
    const auto genes = evidence.statistics.number(statistic + ".genes");
    const auto sizes = evidence.statistics.quantity(statistic + ".size");
    std::string elites = "–";
    if (!sizes.empty()) {
      const Summary s = summarise(sizes, statistic.c_str());
      elites = format_quartiles(s.median, s.q1, s.q3, "");
    }
    std::string descriptor = "–", fitness = "–";
    if (const auto files = evidence.artifacts.replications(layer.name); !files.empty()) {
      descriptor = in_words(read_unit_columns(files[0], "measures"));
      fitness = escape_html(squares(read_value_meaning(files[0], "objective").meaning));
    }
    if (const auto [first, is_new] = told.emplace(descriptor + fitness, layer.name);
        !is_new && fitness != "–") {
      descriptor = fmt::format("as <code>{}</code>", escape_html(first->second));
      fitness = descriptor;
    }
    rows.push_back({fmt::format("<code>{}</code>", escape_html(layer.name)), escape_html(layer.meaning),
                    layer.below.empty() ? "the joints"
                                        : fmt::format("{} of <code>{}</code>", escape_html(layer.asks),
                                                      escape_html(layer.below)),
                    descriptor, fitness, genes ? format_number(*genes) : "–", elites});
  }
  return html_table("The layers of this profile; elites: median and quartiles over the replications",
                    {"Layer", "Makes", "Commands", "Descriptor", "Fitness", "Genes at most", "Elites"}, rows,
                    "layers");
}

}  // namespace hbr::inline reports
