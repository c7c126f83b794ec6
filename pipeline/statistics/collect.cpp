#include "pipeline/statistics/collect.h"

#include "pipeline/statistics/readers.h"

namespace hbr::inline statistics {
namespace {

// The last word of a quantity's name is what was measured, the rest whose it is.
struct Split {
  std::string subject, measure;
};

Split split_last(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  return {name.substr(0, dot), name.substr(dot + 1)};
}

std::string first_word(const std::string& name) { return name.substr(0, name.find('.')); }

bool of_digits(const std::string& head) { return head == "digit_verdicts" || head == "digit_turns"; }

// Subjects of one family are compared with each other by every measure they share.
std::string family(const Split& name) {
  const std::string head = first_word(name.subject);
  if (name.measure == "evaluations") return "";
  if (head == "layer1_search")
    return name.measure == "coverage" || name.measure == "qd_score" || name.measure == "mean" ? "searches"
                                                                                              : "";
  if (head == "layer2" || head == "reference4d") return name.measure == "size" ? "lines" : "";  // no fitness
  if (head == "layer3" || head == "flat_arcs") return "arcs";
  if (head == "layer4" || head == "flat_digits") return "drawings";
  if (head == "accuracy") return "accuracy";
  if (of_digits(head)) return head;
  if (head == "substitution") return name.subject;
  if (head == "tuned") {  // gains with those of other robots, all else with the same robot's
    const std::size_t state = name.subject.rfind('.');
    return name.measure.ends_with("gain") ? "tuned" + name.subject.substr(state)
                                          : name.subject.substr(0, state);
  }
  return "";
}

// "digit_verdicts.hbr.good_of_class.4" -> "good_of_class.4".
std::string what_of_digits(const std::string& name) {
  return name.substr(name.find('.', name.find('.') + 1) + 1);
}

void add_tests(StatisticsTable& table) {
  const std::vector<std::string> names = table.names();
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Split a = split_last(names[i]);
    if (family(a).empty()) continue;
    for (std::size_t j = i + 1; j < names.size(); ++j) {
      const Split b = split_last(names[j]);
      // Of accuracies and substitutions the last word is whose it is; of digits the second.
      const bool comparable = family(a) == "accuracy" || first_word(a.subject) == "substitution" ||
                              (of_digits(family(a)) ? what_of_digits(names[i]) == what_of_digits(names[j])
                                                    : a.measure == b.measure);
      if (family(a) == family(b) && comparable) table.test(names[i], names[j]);
    }
  }
}

}  // namespace

nlohmann::json collect_statistics(const std::string& profile,
                                  const std::map<std::string, std::filesystem::path>& inputs,
                                  const std::set<std::string>& layers) {
  ArtifactsByHead artifacts;
  for (const auto& [name, path] : inputs) {
    const ArtifactName parsed = parse_artifact_name(name, layers);
    artifacts[parsed.head].push_back({parsed, path});
  }
  StatisticsTable table(profile);
  read_searches(artifacts, table);
  read_comparison(artifacts["searches"], table);
  read_autoencoders(artifacts["autoencoder"], table);
  read_descriptor(artifacts["descriptor"], table);
  read_judge(artifacts["judge"], table);
  read_accuracy(artifacts["accuracy"], table);
  read_arc_quality(artifacts["arc_quality"], layers, table);
  read_substitution(artifacts["substitution"], table);
  read_digits(artifacts["digit_verdicts"], table);
  read_turns(artifacts["digit_turns"], table);
  read_confusion(artifacts["autoencoder"], artifacts["digit_verdicts"], table);
  read_numbers(artifacts["numbers"], table);
  read_transfer(artifacts["transfer"], table);
  read_dynamics(artifacts["dynamics"], table);
  read_tuned(artifacts["tuned"], table);
  read_planes(artifacts["plane"], table);
  read_projected(artifacts["projected"], table);
  add_tests(table);
  return table.json();
}

}  // namespace hbr::inline statistics
