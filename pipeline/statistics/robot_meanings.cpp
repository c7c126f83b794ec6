#include "pipeline/statistics/meanings.h"

namespace hbr::inline statistics {
namespace {

constexpr std::array kOfTransfer = {
    Entry{"absolute", "%", "{}: absolute pixel difference"},
    Entry{"squared", "%", "{}: squared pixel difference"},
    Entry{"lost", "%",
          "{}: of the arm's good digits those that the judge does not read any more, or otherwise"},
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
    Entry{"travel", "rad", "{}: how far the joints turn along a digit"},
    Entry{"off_board", "%", "{}: digits whose pen goes farther from the board than it draws"},
    Entry{"beyond_limit", "%", "{}: digits that ask a joint for more than its limit"},
    Entry{"lost", "%", "{}: digits that the judge could read and can not any more, or reads otherwise"},
    Entry{"margin", "mm", "{}: how far inside the sole the centre of pressure stays in a digit, at least"},
    Entry{"grip", "", "{}: coefficient of friction that a digit needs under the sole"},
    Entry{"tips", "%", "{}: digits whose centre of pressure leaves the sole"},
    Entry{"faster", "times", "{}: pace at which a joint reaches a limit, over the profile's"},
};

// Of a robot's layer 1, before and after it is moved onto its plane.
constexpr std::array kOfProjected = {
    Entry{"within_before", "", "{}: share of the arm's layer-1 points with an elite within l, as evolved"},
    Entry{"within_after", "", "{}: share of the arm's layer-1 points with an elite within l, projected"},
    Entry{"nearest_before", "l", "{}: median distance from the arm's points to an elite, as evolved"},
    Entry{"nearest_after", "l", "{}: median distance from the arm's points to an elite, projected"},
    Entry{"off_plane_before", "mm", "{}: median distance of the elites from the plane, as evolved"},
    Entry{"off_plane_after", "mm", "{}: median distance of the elites from the plane, projected"},
    Entry{"distance_before", "mm", "{}: median distance of the elites from their places, as evolved"},
    Entry{"distance_after", "mm", "{}: median distance of the elites from their places, projected"},
    Entry{"variance_before", "rad^2", "{}: mean variance of the elites' joints, as evolved"},
    Entry{"variance_after", "rad^2", "{}: mean variance of the elites' joints, projected"},
    Entry{"added", "elites", "{}: elites added where the arm had points and the robot none"},
};

std::optional<Meaning> of_dynamics(const std::vector<std::string>& parts) {
  if (parts.size() < 3) return {};
  const std::string robot = "dynamics of " + parts[1];
  if (parts.size() == 3 && parts[2] == "digits") return Meaning{"digits", robot + ": digits replayed"};
  if (parts.size() == 3 && parts[2] == "duration") return Meaning{"s", robot + ": duration of a digit"};
  for (const auto& [player, words] : {std::pair<std::string, std::string>{"arm", "drawing joints alone"},
                                      {"whole", "whole body"},
                                      {"wanted", "the joints' smooth way"},
                                      {"elites", "the smooth way through layer 1's own postures"}}) {
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

// States of the layers over a robot, or over the arm, of which the control is made.
constexpr std::array kStates = {
    Entry{"before", "", "the arm's layers as they are"},
    Entry{"top", "", "layer 4 evolved on"},
    Entry{"all", "", "layers 2, 3 and 4 evolved on"},
};

constexpr std::array kOfTunedDigits = {
    Entry{"size", "elites", "{}: digits"},
    Entry{"mean", "fitness", "{}: mean fitness of the digits"},
    Entry{"good", "", "{}: share of the digits that the judge calls good"},
    Entry{"difference", "%", "{}: absolute pixel difference between an arm's digit and the one at its place"},
    Entry{"gain", "fitness", "{}: mean fitness of the digits above that before"},
    Entry{"good_gain", "", "{}: share of good digits above that before"},
};

// Asked for beside the places that the arm's repertoires hold.
constexpr std::array kOfTunedStrokes = {
    Entry{"line", "m", "{}: distance between a line's displacement and the one asked for"},
    Entry{"line_from_arm", "m", "{}: distance between a line's displacement and the arm's"},
    Entry{"arc_centre", "m", "{}: distance between an arc's centre and the one asked for"},
    Entry{"arc_centre_from_arm", "m", "{}: distance between an arc's centre and the arm's"},
    Entry{"arc_length", "m", "{}: difference between an arc's length and the one asked for"},
    Entry{"arc_fitness", "fitness", "{}: fitness of an arc, mean over fresh starts"},
    Entry{"arc_length_from_arm", "m", "{}: difference between an arc's length and the arm's"},
};

std::optional<Meaning> of_tuned(const std::vector<std::string>& parts) {
  if (parts.size() != 4) return {};
  const Entry* state = find_entry(kStates, parts[2]);
  const Entry* entry = find_entry(kOfTunedDigits, parts[3]);
  if (!entry && parts[2] != "top") entry = find_entry(kOfTunedStrokes, parts[3]);
  if (!state || !entry || (parts[2] == "before" && parts[3].ends_with("gain"))) return {};
  return make(*entry, fmt::format("fine-tuning, {}, {}", parts[1], state->text));
}

}  // namespace

std::optional<Meaning> meaning_of_robots(const std::vector<std::string>& parts) {
  if (parts[0] == "tuned") return of_tuned(parts);
  if (parts[0] == "dynamics") return of_dynamics(parts);
  if (parts.size() != 3) return {};
  if (parts[0] == "transfer") {
    const std::string as_evolved = "evolved_";
    const bool evolved = parts[2].starts_with(as_evolved);
    if (const Entry* entry = find_entry(kOfTransfer, evolved ? parts[2].substr(as_evolved.size()) : parts[2]))
      return make(*entry, "transfer to " + parts[1] + (evolved ? ", its layer 1 as evolved" : ""));
  }
  if (parts[0] == "projected")
    if (const Entry* entry = find_entry(kOfProjected, parts[2])) return make(*entry, parts[1]);
  if (parts[0] == "plane" && parts[2] == "scale")
    return Meaning{"", fmt::format("{}: metres of the robot per metre of the arm", parts[1])};
  if (parts[0] == "plane" && parts[2] == "covered")
    return Meaning{"", fmt::format("{}: share of the arm's layer-1 points in its reach", parts[1])};
  return {};
}

}  // namespace hbr::inline statistics
