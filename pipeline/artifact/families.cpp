#include "pipeline/artifact/families.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>

#include "pipeline/core/check.h"

namespace hbr::inline artifact {
namespace {

struct Family {
  std::string variation;
  std::vector<std::string> stages;
  int runs = 0;
  std::set<std::size_t> needs;  // families
};

std::string first_word(const std::string& stage) { return stage.substr(0, stage.find('_')); }
std::string last_word(const std::string& stage) { return stage.substr(stage.rfind('_') + 1); }

bool alike(const std::string& a, const std::string& b) {
  return first_word(a) == first_word(b) || last_word(a) == last_word(b);
}

// Each family behind those that it needs.
class Families {
 public:
  explicit Families(const std::vector<StageBox>& stages) {
    for (const StageBox& stage : stages) stages_[target(stage)] = &stage;
    std::size_t left = stages_.size();
    while (left > 0) {
      // All stages whose needs have a place, so that families are found whole.
      std::vector<const StageBox*> ready;
      for (const auto& [name, stage] : stages_)
        if (!family_.contains(name) && std::ranges::all_of(stage->needs, [&](const std::string& need) {
              return family_.contains(need);
            }))
          ready.push_back(stage);
      if (ready.empty()) throw InputError("stages need each other in a circle, or one that is not there");
      place(ready);
      left -= ready.size();
    }
  }
  const std::vector<Family>& all() const { return families_; }

 private:
  static std::string target(const StageBox& stage) {
    return stage.variation.empty() ? stage.stage : stage.variation + "/" + stage.stage;
  }

  void place(const std::vector<const StageBox*>& ready) {
    const std::size_t first = families_.size();
    std::map<std::string, std::size_t> placed;
    for (const StageBox* stage : ready) {
      std::set<std::size_t> needs;
      for (const std::string& need : stage->needs) needs.insert(family_.at(need));
      std::size_t at = first;
      while (at < families_.size() &&
             !(families_[at].variation == stage->variation && families_[at].needs == needs &&
               std::ranges::any_of(families_[at].stages,
                                   [&](const std::string& other) { return alike(other, stage->stage); })))
        ++at;
      if (at == families_.size()) families_.push_back({stage->variation, {}, 0, needs});
      families_[at].stages.push_back(stage->stage);
      families_[at].runs += stage->runs;
      placed[target(*stage)] = at;
    }
    family_.merge(placed);
  }

  std::map<std::string, const StageBox*> stages_;
  std::map<std::string, std::size_t> family_;
  std::vector<Family> families_;
};

// "layer2*", "*_plane", and how many there are.
std::string label(const Family& family) {
  const std::vector<std::string>& stages = family.stages;
  const std::string& one = stages.front();
  if (stages.size() == 1) return one + (family.runs > 1 ? fmt::format("\\n\u00d7 {}", family.runs) : "");
  const bool end =
      std::ranges::all_of(stages, [&](const std::string& s) { return last_word(s) == last_word(one); });
  const std::string name = end ? "*_" + last_word(one) : first_word(one) + "*";
  return fmt::format("{}\\n{} stages, \u00d7 {}", name, stages.size(), family.runs);
}

// The needs that no other need implies.
std::set<std::size_t> direct(const std::vector<Family>& families, const Family& family) {
  std::set<std::size_t> implied, result;
  const std::function<void(std::size_t)> imply = [&](std::size_t i) {
    for (const std::size_t need : families[i].needs)
      if (implied.insert(need).second) imply(need);
  };
  for (const std::size_t need : family.needs) imply(need);
  std::ranges::set_difference(family.needs, implied, std::inserter(result, result.end()));
  return result;
}

}  // namespace

std::string stages_as_dot(const std::vector<StageBox>& stages, const DotColours& colours) {
  const Families grouped(stages);
  const std::vector<Family>& families = grouped.all();
  std::map<std::string, std::string> boxes;  // of a variation
  std::string arrows;
  for (std::size_t i = 0; i < families.size(); ++i) {
    boxes[families[i].variation] += fmt::format("  f{} [label=\"{}\"];\n", i, label(families[i]));
    for (const std::size_t need : direct(families, families[i]))
      arrows += fmt::format("  f{} -> f{};\n", need, i);
  }
  std::string dot = fmt::format(
      "digraph experiment {{\n  bgcolor=transparent; nodesep=0.2; ranksep=0.35;\n"
      "  node [shape=box, style=\"rounded,filled\", fillcolor=\"{}\", color=\"{}\", fontcolor=\"{}\", "
      "fontname=\"sans-serif\", fontsize=13, height=0.3];\n  edge [color=\"{}\", arrowsize=0.6];\n",
      colours.fill, colours.line, colours.text, colours.line);
  for (const auto& [variation, text] : boxes)
    dot += variation.empty()
               ? text
               : fmt::format("  subgraph \"cluster_{0}\" {{ label=\"{0}\"; color=\"{1}\";\n{2}  }}\n",
                             variation, colours.line, text);
  return dot + arrows + "}\n";
}

}  // namespace hbr::inline artifact
