#include "reports/figures/contender.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>

namespace hbr::inline reports {
namespace {

struct Row {
  const char* id;
  const char* label;
  Colour colour;
};

// By the word of a name that says who it is: "layer3.n10.size" is n10's.
constexpr std::array kContenders = {
    Row{"hbr", "HBR", Colour::blue},
    Row{"layer1", "layer 1", Colour::blue},
    Row{"layer4", "HBR", Colour::blue},
    Row{"flat", "flat", Colour::vermilion},
    Row{"flat_arcs", "flat", Colour::vermilion},
    Row{"flat_digits", "flat", Colour::vermilion},
    Row{"n1", "1 sample", Colour::orange},
    Row{"n10_short", "10, short", Colour::sky},
    Row{"n10", "10 samples", Colour::blue},
    Row{"n100", "100 samples", Colour::green},
    Row{"b", "controller B", Colour::purple},
    Row{"reference4d", "4-D", Colour::vermilion},
    Row{"reference_endpoint", "4-D, end", Colour::vermilion},
    Row{"reference_displacement", "4-D, shift", Colour::purple},
    Row{"curiosity", "curiosity",
        Colour::blue},  // of layer 1's other searches the colour tells the container
    Row{"uniform", "uniform", Colour::blue},
    Row{"novelty", "novelty", Colour::blue},
    Row{"fitness", "fitness", Colour::blue},
    Row{"local_curiosity", "local curiosity", Colour::green},
    Row{"nslc", "NSLC", Colour::green},
    Row{"grid", "grid", Colour::orange},
    Row{"cvt", "CVT", Colour::purple},
    Row{"original", "original", Colour::blue},
    Row{"substitute", "substitute", Colour::orange},
    Row{"nao", "NAO", Colour::green},
    Row{"absolute", "absolute", Colour::blue},
    Row{"evolved_absolute", "as evolved", Colour::blue},
    Row{"squared", "squared", Colour::purple},
    Row{"evolved_squared", "as evolved", Colour::purple},
    Row{"line_end", "line,\nend", Colour::sky},
    Row{"line_displacement", "line,\nshift", Colour::sky},
    Row{"arc_end", "arc,\nend", Colour::orange},
    Row{"arc_centre", "arc,\ncentre", Colour::orange},
    Row{"arc_length", "arc,\nlength", Colour::orange},
    Row{"arm", "arm", Colour::blue},
    Row{"before", "before", Colour::vermilion},
    Row{"top", "layer 4", Colour::orange},  // a no-break space
    Row{"all", "all", Colour::green},
    Row{"elites_absolute", "elites", Colour::green},
    Row{"wanted_absolute", "asked", Colour::grey},
    Row{"arm_absolute", "arm", Colour::blue},
    Row{"whole_absolute", "body", Colour::orange},
    Row{"arm_rms", "arm,\nrms", Colour::blue},
    Row{"arm_max", "arm,\nmost", Colour::blue},
    Row{"whole_rms", "body,\nrms", Colour::orange},
    Row{"whole_max", "body,\nmost", Colour::orange},
    Row{"arm_torque", "torque,\narm", Colour::blue},
    Row{"whole_torque", "torque,\nbody", Colour::orange},
    Row{"arm_speed", "speed,\narm", Colour::blue},
    Row{"whole_speed", "speed,\nbody", Colour::orange},
    Row{"arm_faster", "arm", Colour::blue},
    Row{"whole_faster", "body", Colour::orange},
    Row{"whole_margin", "body", Colour::orange},
    Row{"whole_grip", "body", Colour::orange},
};

// "RShoulderPitch" -> "RShoulder" above "Pitch".
std::string in_two_lines(const std::string& joint) {
  for (std::size_t at = joint.size(); at-- > 3;)
    if (std::isupper(static_cast<unsigned char>(joint[at])) || joint[at] == '_')
      return fmt::format("{}\n{}", joint.substr(0, at), joint.substr(at));
  return joint;
}

// By the state of the layers: "tuned.nao.top.gain" is layer 4's; the arm in a robot's place is the control.
Contender tuned_contender(const std::string& name) {
  const std::size_t robot = name.find('.') + 1, state = name.find('.', robot) + 1;
  const Contender who = contender(name.substr(state, name.find('.', state) - state));
  if (name.substr(robot, state - robot) != "arm.") return {name, who.label, who.colour};
  return {name, who.name == "before" ? "arm" : fmt::format("arm,\n{}", who.label), Colour::blue};
}

// "digit_turns.hbr.of_good" -> "HBR" above "good".
Contender turns_contender(const std::string& name) {
  using Which = std::pair<const char*, const char*>;
  static constexpr std::array kWhich = {Which{"of_good", "good"}, Which{"of_refused", "refused"},
                                        Which{"joints", "joints"}};
  const std::size_t who = name.find('.') + 1, measure = name.find('.', who) + 1;
  const Contender drawer = contender(name.substr(who, measure - who - 1));
  const auto which =
      std::ranges::find(kWhich, name.substr(measure), [](const auto& w) { return std::string(w.first); });
  return {name, which == kWhich.end() ? drawer.label : fmt::format("{},\n{}", drawer.label, which->second),
          drawer.colour};
}

}  // namespace

std::string robot_title(const std::string& name) {
  std::istringstream words(name);
  std::string title;
  for (std::string word; std::getline(words, word, '_');) {
    if (title.empty() && !word.empty())
      word[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(word[0])));
    if (word == "Nao" || word == "nao") word = "NAO";
    title += (title.empty() ? "" : " ") + word;
  }
  return title;
}

Contender contender(const std::string& name) {
  if (name.starts_with("tuned.")) return tuned_contender(name);
  if (name.starts_with("digit_turns.")) return turns_contender(name);
  // The last word that the table knows: in "layer1.nao.size" NAO, not layer 1.
  std::istringstream words(name);
  const Row* who = nullptr;
  for (std::string word; std::getline(words, word, '.');) {
    const auto row = std::ranges::find(kContenders, word, [](const Row& r) { return std::string(r.id); });
    if (row != kContenders.end()) who = &*row;
  }
  // One joint of a robot's servos: "dynamics.nao.arm_torque_of.RShoulderPitch".
  if (const std::size_t dot = name.rfind('.');
      dot != std::string::npos && name.substr(0, dot).ends_with("_of"))
    return {name, in_two_lines(name.substr(dot + 1)), Colour::green};
  // Layers and robots that the table does not know have the names that the profile gives them.
  const auto second_word = [&] {
    const std::size_t dot = name.find('.') + 1;
    return name.substr(dot, name.find('.', dot) - dot);
  };
  if (!who && name.starts_with("layers.")) return {name, second_word(), Colour::blue};
  if (!who && name.starts_with("numbers."))
    return {name, std::ranges::count(name, '.') > 1 ? robot_title(second_word()) : "arm", Colour::blue};
  return who ? Contender{name, who->label, who->colour} : Contender{name, name, Colour::grey};
}

}  // namespace hbr::inline reports
