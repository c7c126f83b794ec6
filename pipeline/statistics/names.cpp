#include "pipeline/statistics/names.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "pipeline/core/check.h"
#include "pipeline/statistics/meanings.h"

namespace hbr::inline statistics {
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
    Head{"layers", "layer", true, false},
    Head{"searches", "searches compared", false, false},
    Head{"autoencoder", "autoencoder", false, false},
    Head{"descriptor", "descriptor", false, false},
    Head{"judge", "judge", false, false},
    Head{"dataset", "dataset", false, false},
    Head{"accuracy", "accuracy", false, false},
    Head{"arc_quality", "arcs drawn again", false, false},
    Head{"substitution", "substitution of layer 1", false, false},
    Head{"digit_verdicts", "digits", false, false},
    Head{"digit_turns", "strokes of the digits", false, false},
    Head{"surest_digits", "the arm at work", false, false},
    Head{"numbers", "numbers", false, true},
    Head{"transfer", "transfer", false, true},
    Head{"plane", "drawing plane", false, true},
    Head{"projected", "layer 1 on its plane", false, true},
    Head{"dynamics", "dynamics", false, true},
    Head{"tuned_lines", "fine-tuning of layer 2", false, true},
    Head{"tuned_arcs", "fine-tuning of layer 3", false, true},
    Head{"tuned_top", "fine-tuning of layer 4 alone", false, true},
    Head{"tuned_all", "fine-tuning of all layers", false, true},
    Head{"tuned", "fine-tuning", false, true},
    Head{"picture", "picture", false, true},
    Head{"shape", "shape", false, true},
    Head{"ways", "postures along the digits", false, true},
};

const Head* find_head(std::string_view name) {
  const auto found = std::ranges::find(kHeads, name, &Head::name);
  return found == kHeads.end() ? nullptr : &*found;
}

}  // namespace

bool is_search(const std::string& head) {
  const Head* found = find_head(head);
  return found && found->search;
}

std::string search_words(const std::string& head) {
  const Head* found = find_head(head);
  return found && found->search ? found->words : "";
}

ArtifactName parse_artifact_name(const std::string& name, const std::set<std::string>& layers) {
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
  if (!best && layers.contains(stage)) return {"layers", stage, result.replication};
  if (!best || result.variant.find('.') != std::string::npos) throw fail();
  result.head = best->name;
  return result;
}

bool can_be_a_layers_name(const std::string& name) {
  constexpr std::array kTaken = {"experiment", "page", "readings", "report"};
  if (std::ranges::find(kTaken, name) != kTaken.end() || goals_of_make().contains(name)) return false;
  return is_search(parse_artifact_name(name, {name}).head);
}

const std::set<std::string>& goals_of_make() {
  static const std::set<std::string> goals{
      "help",          "deps",         "build",       "data",    "all",       "keys",
      "test",          "bench",        "sanitize",    "fuzz",    "mutate",    "coverage",
      "format",        "check-format", "status",      "audit",   "graph",     "reference",
      "figures",       "verify",       "export",      "compare", "robot",     "install",
      "check-targets", "check-odr",    "check-bytes", "clean",   "distclean", "test-cluster",
      "check-releases"};
  return goals;
}

}  // namespace hbr::inline statistics
