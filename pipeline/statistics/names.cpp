#include "pipeline/statistics/names.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <string_view>

#include "pipeline/core/check.h"

namespace hbr {
namespace {

struct Head {
  const char* name;
  const char* words;  // in a meaning
  bool search;
  bool after_robot;  // "nao_transfer" instead of "transfer_nao"
};

constexpr std::array kHeads = {
    Head{"layer1", "layer 1 (points)", true, true},
    Head{"layer1_search", "layer 1 (points)", true, false},
    Head{"layer2", "layer 2 (lines)", true, false},
    Head{"reference4d", "four-dimensional reference (lines)", true, false},
    Head{"layer3", "layer 3 (arcs)", true, false},
    Head{"flat_arcs", "flat baseline (arcs)", true, false},
    Head{"layer4", "layer 4 (digits)", true, false},
    Head{"flat_digits", "flat baseline (digits)", true, false},
    Head{"searches", "searches compared", false, false},
    Head{"autoencoder", "autoencoder", false, false},
    Head{"descriptor", "descriptor", false, false},
    Head{"judge", "judge", false, false},
    Head{"dataset", "dataset", false, false},
    Head{"accuracy", "accuracy", false, false},
    Head{"arc_quality", "arcs drawn again", false, false},
    Head{"substitution", "substitution of layer 1", false, false},
    Head{"digits", "digits", false, false},
    Head{"strokes", "strokes", false, false},
    Head{"transfer", "transfer", false, true},
    Head{"plane", "drawing plane", false, true},
    Head{"polish", "layer 1 on its plane", false, true},
    Head{"dynamics", "dynamics", false, true},
    Head{"tuned", "fine-tuning", false, true},
    Head{"picture", "picture", false, true},
};

const Head* find_head(std::string_view name) {
  const auto found = std::ranges::find(kHeads, name, &Head::name);
  return found == kHeads.end() ? nullptr : &*found;
}

// {} in a meaning stands for the subject: the layer, its variant, the robot.
struct Entry {
  const char* name;
  const char* unit;
  const char* text;
};

constexpr std::array kOfSearch = {
    Entry{"size", "elites", "{}: elites in the repertoire"},
    Entry{"best", "fitness", "{}: best fitness"},
    Entry{"mean", "fitness", "{}: mean fitness"},
    Entry{"evaluations", "evaluations", "{}: genomes evaluated"},
    Entry{"executions", "executions", "{}: executions, one for each sample of each genome"},
    Entry{"fresh_mean", "fitness", "{}: mean fitness of its elites, executed again from fresh starts"},
    Entry{"equal_size", "elites", "{}: elites at equal generations"},
    Entry{"equal_best", "fitness", "{}: best fitness at equal generations"},
    Entry{"equal_mean", "fitness", "{}: mean fitness at equal generations"},
    Entry{"covering_generations", "generations",
          "{}: generations until 90 % of its size at equal generations is reached"},
    Entry{"generations", "generations", "{}: generations of the search"},
    Entry{"genes", "genes", "{}: genes of a genome (the longest)"},
};

// Of searches projected onto one passive grid.
constexpr std::array kOfCells = {
    Entry{"coverage", "",
          "{}: share of the cells of a common grid that it fills, of those that any search fills"},
    Entry{"qd_score", "fitness",
          "{}: sum over the cells of a common grid of the best fitness above the worst there can be"},
    Entry{"cell_mean", "fitness", "{}: mean over the filled cells of a common grid of the best fitness"},
};

constexpr std::array kOfDigits = {
    Entry{"cells", "",
          "{}: share of the cells of side 0.1 of the latent square (of its first two dimensions) that hold "
          "an elite"},
    Entry{"classes", "classes", "{}: classes with at least three good images"},
    Entry{"good", "", "{}: share of images that the judge calls good"},
    Entry{"good_01", "", "{}: share of good images among those the judge takes for 0 or 1"},
    Entry{"good_others", "", "{}: share of good images among those the judge takes for 2 to 9"},
    Entry{"confidence", "", "{}: mean confidence of the judge"},
    Entry{"distance", "", "{}: median distance to the nearest image of the dataset"},
    Entry{"agreement", "",
          "{}: rank correlation between the network's opinion (fitness) and the judge's (confidence)"},
    Entry{"rarest", "", "{}: good images of the rarest class, over the mean of the classes"},
    Entry{"reach", "", "{}: greatest absolute latent coordinate"},
    Entry{"neighbour_difference", "", "{}: mean pixel difference between an image and its latent neighbour"},
    Entry{"pair_difference", "", "{}: mean pixel difference between any two images"},
};

constexpr std::array kOfTransfer = {
    Entry{"absolute", "%", "{}: absolute pixel difference"},
    Entry{"squared", "%", "{}: squared pixel difference"},
    Entry{"images", "images", "{}: images drawn by both"},
    Entry{"line_end", "m", "{}: distance between the ends of a line from a common start"},
    Entry{"line_displacement", "m", "{}: distance between the displacements of a line"},
    Entry{"arc_end", "m", "{}: distance between the ends of an arc from a common start"},
    Entry{"arc_centre", "m", "{}: distance between the centres of an arc"},
    Entry{"arc_length", "m", "{}: difference between the lengths of an arc"},
    Entry{"absolute_median", "%", "{}: absolute pixel difference, median over all images"},
    Entry{"absolute_low", "%", "{}: absolute pixel difference, least without outliers"},
    Entry{"absolute_high", "%", "{}: absolute pixel difference, greatest without outliers"},
    Entry{"absolute_outliers", "%", "{}: images whose absolute difference is an outlier above"},
    Entry{"squared_median", "%", "{}: squared pixel difference, median over all images"},
    Entry{"squared_low", "%", "{}: squared pixel difference, least without outliers"},
    Entry{"squared_high", "%", "{}: squared pixel difference, greatest without outliers"},
    Entry{"squared_outliers", "%", "{}: images whose squared difference is an outlier above"},
};

// Of digits replayed by servos: by the arm alone and by the whole body.
constexpr std::array kOfReplays = {
    Entry{"rms", "mm", "{}: distance of the tip from its way, root mean square over a digit"},
    Entry{"max", "mm", "{}: greatest distance of the tip from its way"},
    Entry{"off_plane", "mm", "{}: greatest distance of the tip from the drawing plane"},
    Entry{"absolute", "%", "{}: absolute pixel difference from the digit before"},
    Entry{"squared", "%", "{}: squared pixel difference from the digit before"},
    Entry{"torque", "%", "{}: greatest torque of a digit, of its joint's limit"},
    Entry{"speed", "%", "{}: greatest speed of a digit, of its joint's limit"},
    Entry{"faster", "times", "{}: pace at which a joint reaches a limit, over the profile's"},
};

// Of a robot's layer 1, before and after it is moved onto its plane.
constexpr std::array kOfPolish = {
    Entry{"within_before", "", "{}: share of the arm's layer-1 points with an elite within l, as evolved"},
    Entry{"within_after", "", "{}: share of the arm's layer-1 points with an elite within l, polished"},
    Entry{"nearest_before", "l", "{}: median distance from the arm's points to an elite, as evolved"},
    Entry{"nearest_after", "l", "{}: median distance from the arm's points to an elite, polished"},
    Entry{"off_plane_before", "mm", "{}: median distance of the elites from the plane, as evolved"},
    Entry{"off_plane_after", "mm", "{}: median distance of the elites from the plane, polished"},
    Entry{"distance_before", "mm", "{}: median distance of the elites from their places, as evolved"},
    Entry{"distance_after", "mm", "{}: median distance of the elites from their places, polished"},
    Entry{"variance_before", "rad^2", "{}: mean variance of the elites' joints, as evolved"},
    Entry{"variance_after", "rad^2", "{}: mean variance of the elites' joints, polished"},
    Entry{"added", "elites", "{}: elites added where the arm had points and the robot none"},
};

constexpr std::array kSingle = {
    Entry{"accuracy.requests", "requests", "accuracy: lines requested of a repertoire"},
    Entry{"searches.passive_cells", "cells", "searches compared: cells a side of the common grid"},
    Entry{"searches.filled_by_any", "cells", "searches compared: cells of the common grid that any fills"},
    Entry{"searches.worst_fitness", "fitness", "searches compared: a fitness that no elite falls short of"},
    Entry{"autoencoder.test_error", "", "autoencoder: mean squared error per pixel on the test images"},
    Entry{"autoencoder.kept", "", "autoencoder: share of the training images kept by the cut"},
    Entry{"autoencoder.reach", "", "autoencoder: greatest absolute latent coordinate of the test images"},
    Entry{"autoencoder.epochs", "epochs", "autoencoder: epochs of training"},
    Entry{"descriptor.test_error", "",
          "descriptor in place of the autoencoder: mean squared error per pixel on the test images"},
    Entry{"judge.test_accuracy", "", "judge: accuracy on the test images"},
    Entry{"judge.test_typical", "", "judge: share of the test images it calls typical"},
    Entry{"judge.random_typical", "", "judge: share of random strokes it calls typical"},
    Entry{"pooled.layer2_size", "elites", "layer 2 (lines), all variants together: elites in the repertoire"},
    Entry{"genes.hierarchy", "genes", "genes of layers 1, 2 and 3 together (arc controller B)"},
};

template <std::size_t N>
const Entry* find_entry(const std::array<Entry, N>& entries, std::string_view name) {
  const auto found = std::ranges::find(entries, name, &Entry::name);
  return found == entries.end() ? nullptr : &*found;
}

bool is_number(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](unsigned char c) { return std::isdigit(c) != 0; });
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts(1);
  for (const char c : text) {
    if (c == at)
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

// "n10" -> "N = 10", "n10_short" -> "N = 10, short", "b" -> "controller B".
std::string variant_words(const std::string& variant) {
  if (variant == "a" || variant == "b")
    return std::string("controller ") + static_cast<char>(std::toupper(variant[0]));
  std::string words;
  for (const std::string& part : split(variant, '_')) {
    if (!words.empty()) words += ", ";
    words += part.size() > 1 && part[0] == 'n' && is_number(part.substr(1)) ? "N = " + part.substr(1) : part;
  }
  return words;
}

Meaning make(const Entry& entry, const std::string& subject) {
  return {entry.unit, fmt::format(fmt::runtime(entry.text), subject)};
}

std::optional<Meaning> of_search(const std::vector<std::string>& parts) {
  const Head* head = find_head(parts[0]);
  if (!head || !head->search || parts.size() < 2 || parts.size() > 3) return {};
  const Entry* entry = find_entry(kOfSearch, parts.back());
  if (!entry && parts[0] == "layer1_search") entry = find_entry(kOfCells, parts.back());
  if (!entry) return {};
  const std::string variant = parts.size() == 3 ? ", " + variant_words(parts[1]) : "";
  return make(*entry, head->words + variant);
}

std::optional<Meaning> of_digits(const std::vector<std::string>& parts) {
  if (parts.size() == 4 && is_number(parts[3]))
    for (const auto& [measure, which] :
         {std::pair{"good_of_class", "good images"}, std::pair{"all_of_class", "images"}})
      if (parts[2] == measure)
        return Meaning{"images", fmt::format("digits, {}: {} that the judge takes for a {}",
                                             variant_words(parts[1]), which, parts[3])};
  const Entry* entry = parts.size() == 3 ? find_entry(kOfDigits, parts[2]) : nullptr;
  if (!entry) return {};
  return make(*entry, "digits, " + variant_words(parts[1]));
}

std::optional<Meaning> of_dynamics(const std::vector<std::string>& parts) {
  if (parts.size() < 3) return {};
  const std::string robot = "dynamics of " + parts[1];
  if (parts.size() == 3 && parts[2] == "digits") return Meaning{"digits", robot + ": digits replayed"};
  if (parts.size() == 3 && parts[2] == "duration") return Meaning{"s", robot + ": duration of a digit"};
  for (const auto& [player, words] : {std::pair<std::string, std::string>{"arm", "drawing joints alone"},
                                      {"whole", "whole body"},
                                      {"wanted", "the joints' smooth way"}}) {
    if (!parts[2].starts_with(player + "_")) continue;
    const std::string measure = parts[2].substr(player.size() + 1), subject = robot + ", " + words;
    if (parts.size() == 4 && (measure == "torque_of" || measure == "speed_of"))
      return Meaning{"%", fmt::format("{}: greatest {} of {} in a digit, of its limit", subject,
                                      measure.substr(0, measure.size() - 3), parts[3])};
    const Entry* entry = parts.size() == 3 ? find_entry(kOfReplays, measure) : nullptr;
    if (entry) return make(*entry, subject);
  }
  return {};
}

std::optional<Meaning> of_tuned(const std::vector<std::string>& parts) {
  if (parts.size() != 4) return {};
  static constexpr std::array kWhose = {
      std::pair{"arm", "the arm's digits"},
      std::pair{"before", "the same by the robot"},
      std::pair{"after", "the robot's digits when they have evolved on"},
  };
  static constexpr std::array kOfTuned = {
      Entry{"size", "elites", "{}: elites"},
      Entry{"mean", "fitness", "{}: mean fitness"},
      Entry{"good", "", "{}: share that the judge calls good"},
      Entry{"difference", "%",
            "{}: absolute pixel difference between an arm's digit and the one at its place"},
  };
  const auto whose = std::ranges::find(kWhose, parts[2], [](const auto& w) { return std::string(w.first); });
  const Entry* entry = find_entry(kOfTuned, parts[3]);
  if (whose == kWhose.end() || !entry || (parts[2] == "arm" && parts[3] == "difference")) return {};
  return make(*entry, fmt::format("fine-tuning of {}, {}", parts[1], whose->second));
}

}  // namespace

bool is_search(const std::string& head) {
  const Head* found = find_head(head);
  return found && found->search;
}

ArtifactName parse_artifact_name(const std::string& name) {
  const auto fail = [&] {
    return InputError(
        "'{}' is no artifact's name; expected one of those in pipeline/artifact/FORMAT.md, such as "
        "layer2_n10/03.h5",
        name);
  };
  ArtifactName result;
  std::string stage = name;
  if (stage.ends_with(".h5")) stage.resize(stage.size() - 3);
  if (const std::size_t slash = stage.find('/'); slash != std::string::npos) {
    const std::string number = stage.substr(slash + 1);
    if (!is_number(number) || number.size() > 6) throw fail();
    result.replication = std::stoi(number);
    stage.resize(slash);
  }
  const Head* best = nullptr;
  for (const Head& head : kHeads) {
    const std::string word = head.name;
    if (stage == word || stage.starts_with(word + "_")) {
      if (best && std::string_view(best->name).size() > word.size()) continue;
      best = &head;
      result.variant = stage == word ? "" : stage.substr(word.size() + 1);
    } else if (head.after_robot && stage.ends_with("_" + word)) {
      best = &head;
      result.variant = stage.substr(0, stage.size() - word.size() - 1);
    }
  }
  if (!best || result.variant.find('.') != std::string::npos) throw fail();
  result.head = best->name;
  return result;
}

std::optional<Meaning> meaning_of(const std::string& name) {
  const std::vector<std::string> parts = split(name, '.');
  if (std::ranges::any_of(parts, &std::string::empty)) return {};
  if (const Entry* entry = find_entry(kSingle, name)) return Meaning{entry->unit, entry->text};
  if (auto meaning = of_search(parts)) return meaning;
  if (parts[0] == "digits") return of_digits(parts);
  if (parts[0] == "accuracy" && parts.size() == 2)
    return Meaning{"m^2", fmt::format("accuracy, {}: median squared error of the requested lines",
                                      variant_words(parts[1]))};
  if (parts[0] == "substitution" && parts.size() == 3 &&
      (parts[1] == "m1" || parts[1] == "m2" || parts[1] == "m3"))
    return Meaning{"fitness", fmt::format("M{} of the arcs, over the {} layer 1", parts[1][1], parts[2])};
  if (parts[0] == "transfer" && parts.size() == 3)
    if (const Entry* entry = find_entry(kOfTransfer, parts[2]))
      return make(*entry, "transfer to " + parts[1]);
  if (parts[0] == "tuned") return of_tuned(parts);
  if (parts[0] == "dynamics") return of_dynamics(parts);
  if (parts[0] == "polish" && parts.size() == 3)
    if (const Entry* entry = find_entry(kOfPolish, parts[2])) return make(*entry, parts[1]);
  if (parts[0] == "plane" && parts.size() == 3 && parts[2] == "scale")
    return Meaning{"", fmt::format("{}: metres of the robot per metre of the arm", parts[1])};
  if (parts[0] == "plane" && parts.size() == 3 && parts[2] == "covered")
    return Meaning{"", fmt::format("{}: share of the arm's layer-1 points in its reach", parts[1])};
  if (parts[0] == "autoencoder" && parts.size() == 3 && parts[1] == "kept_of_class" && is_number(parts[2]))
    return Meaning{"", fmt::format("autoencoder: share of the images of class {} kept by the cut", parts[2])};
  return {};
}

}  // namespace hbr
