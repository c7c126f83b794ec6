#include "pipeline/statistics/meanings.h"

namespace hbr::inline statistics {
namespace {

constexpr std::array kOfSearch = {
    Entry{"size", "elites", "{}: elites in the repertoire"},
    Entry{"best", "fitness", "{}: best fitness"},
    Entry{"mean", "fitness", "{}: mean fitness"},
    Entry{"evaluations", "evaluations", "{}: genomes evaluated"},
    Entry{"executions", "executions", "{}: executions, one for each sample of each genome"},
    Entry{"fresh_mean", "fitness", "{}: mean fitness of its elites, executed again from fresh starts"},
    Entry{"irregularity", "",
          "{}: mean over its elites of what the lengths and turns of their segments cost, from fresh starts"},
    Entry{"joint_term", "rad^2",
          "{}: mean over its elites of the joints' part of their fitness (layer 1's), from fresh starts"},
    Entry{"equal_size", "elites", "{}: elites at equal generations"},
    Entry{"equal_best", "fitness", "{}: best fitness at equal generations"},
    Entry{"equal_mean", "fitness", "{}: mean fitness at equal generations"},
    Entry{"replaced", "",
          "{}: share of the elites held at half of its generations that others replaced later"},
    Entry{"late_gain", "fitness", "{}: what its mean fitness gains in the second half of its generations"},
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
    Entry{
        "border_difference", "",
        "{}: mean pixel difference between an image and its latent neighbour, where the judge takes them for "
        "different classes"},
    Entry{"pair_difference", "", "{}: mean pixel difference between any two images"},
};

// Of a drawing's strokes: turns without their sense, in degrees; and numbers that have an interval (_low,
// _high).
constexpr std::array kOfTurns = {
    Entry{"turn", "°", "{}: mean turn from one segment to the next, a digit's mean, then over the digits"},
    Entry{"within", "°", "{}: mean turn between segments, within an arc where there are arcs"},
    Entry{"joints", "°", "{}: mean turn where one arc ends and the next begins"},
    Entry{"curvature", "°", "{}: mean of what a digit turns on a way as long as the greater side of its box"},
    Entry{"of_good", "°", "{}: mean turn of each digit that the judge calls good"},
    Entry{"of_refused", "°", "{}: mean turn of each digit that the judge does not call good"},
    Entry{"refused_turn_more", "",
          "{}: the chance that a refused digit turns more sharply than a good one (A12)"},
};

constexpr std::array kOfAllTurns = {
    Entry{"flat_turn_more", "",
          "{}: the chance that a flat digit turns more sharply than one of the hierarchy (A12)"},
};

// Numbers of the digits that have an interval.
constexpr std::array kOfClasses = {
    Entry{"good_if_confused", "",
          "{}: rank correlation over the ten classes of their share of the good digits with how often the "
          "network takes them for others"},
    Entry{"good_if_cut", "",
          "{}: rank correlation over the ten classes of their share of the good digits with the share of "
          "their images that the cut removed"},
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

constexpr std::array kOfNumbers = {
    Entry{"legible", "", "{}: share whose digits are all good to the judge and stand clear of each other"},
    Entry{"values", "numbers", "{}: different numbers that can be read"},
};

std::optional<Meaning> of_numbers(const std::vector<std::string>& parts) {
  const Entry* entry = parts.size() <= 3 ? find_entry(kOfNumbers, parts.back()) : nullptr;
  if (!entry || parts.size() < 2) return {};
  return make(*entry, parts.size() == 3 ? "numbers, drawn by " + parts[1] : "numbers");
}

std::optional<Meaning> of_search(const std::vector<std::string>& parts) {
  const std::string layer = search_words(parts[0]);
  if (layer.empty() || parts.size() < 2 || parts.size() > 3) return {};
  const Entry* entry = find_entry(kOfSearch, parts.back());
  if (!entry && parts[0] == "layer1_search") entry = find_entry(kOfCells, parts.back());
  if (!entry) return {};
  const std::string variant = parts.size() == 3 ? ", " + variant_words(parts[1]) : "";
  return make(*entry, layer + variant);
}

// A number with an interval: its ends have the words of its own.
std::string without_end(const std::string& name) {
  for (const std::string end : {"_low", "_high"})
    if (name.ends_with(end)) return name.substr(0, name.size() - end.size());
  return name;
}

std::optional<Meaning> of_turns(const std::vector<std::string>& parts) {
  if (parts.size() != 2 && parts.size() != 3) return {};
  const std::string word = without_end(parts.back());
  const bool bound = word != parts.back();
  const Entry* entry = parts.size() == 2 ? find_entry(kOfAllTurns, word) : find_entry(kOfTurns, word);
  if (!entry || (bound && entry->unit[0])) return {};
  Meaning meaning =
      make(*entry, parts.size() == 2 ? "strokes of the digits" : "digits, " + variant_words(parts[1]));
  if (bound) meaning.text += ", end of its 95 % interval";
  return meaning;
}

std::optional<Meaning> of_digits(const std::vector<std::string>& parts) {
  if (parts.size() == 4 && is_number(parts[3]))
    for (const auto& [measure, which] :
         {std::pair{"good_of_class", "good images"}, std::pair{"all_of_class", "images"}})
      if (parts[2] == measure)
        return Meaning{"images", fmt::format("digits, {}: {} that the judge takes for a {}",
                                             variant_words(parts[1]), which, parts[3])};
  if (parts.size() != 3) return {};
  const std::string subject = "digits, " + variant_words(parts[1]);
  if (const Entry* entry = find_entry(kOfDigits, parts[2])) return make(*entry, subject);
  const Entry* entry = find_entry(kOfClasses, without_end(parts[2]));
  if (!entry) return {};
  Meaning meaning = make(*entry, subject);
  if (parts[2] != entry->name) meaning.text += ", end of its 95 % interval";
  return meaning;
}

}  // namespace

std::optional<Meaning> meaning_of(const std::string& name) {
  const std::vector<std::string> parts = split(name, '.');
  if (std::ranges::any_of(parts, &std::string::empty)) return {};
  if (const Entry* entry = find_entry(kSingle, name)) return Meaning{entry->unit, entry->text};
  if (auto meaning = of_search(parts)) return meaning;
  if (auto meaning = meaning_of_robots(parts)) return meaning;
  if (parts[0] == "digit_verdicts") return of_digits(parts);
  if (parts[0] == "digit_turns") return of_turns(parts);
  if (parts[0] == "numbers") return of_numbers(parts);
  if (parts[0] == "accuracy" && parts.size() == 2)
    return Meaning{"m^2", fmt::format("accuracy, {}: median squared error of the requested lines",
                                      variant_words(parts[1]))};
  if (parts[0] == "substitution" && parts.size() == 3 &&
      (parts[1] == "m1" || parts[1] == "m2" || parts[1] == "m3"))
    return Meaning{"fitness", fmt::format("M{} of the arcs, over the {} layer 1", parts[1][1], parts[2])};
  if (parts[0] == "autoencoder" && parts.size() == 3 && is_number(parts[2]))
    for (const auto& [measure, text] :
         {std::pair{"kept_of_class", "autoencoder: share of the images of class {} kept by the cut"},
          std::pair{"confused_of_class",
                    "autoencoder: share of the test images of class {} whose nearest neighbour in the latent "
                    "space is of another class"},
          std::pair{"taken_for", "autoencoder: the other class that most neighbours of class {} are of"}})
      if (parts[1] == measure)
        return Meaning{measure == std::string_view("taken_for") ? "class" : "",
                       fmt::format(fmt::runtime(text), parts[2])};
  return {};
}

}  // namespace hbr::inline statistics
