// What is done with finished layers.
#include <algorithm>
#include <map>

#include "pipeline/hierarchy/joints.h"
#include "stages/plan/plan.h"

namespace hbr::inline stages {
namespace {

// A layer's name in a study: what tells it from others of its level, "n10" of "layer2_n10".
std::string label(const std::string& name) {
  const std::size_t end = name.find('_');
  return name.starts_with("layer") && end != std::string::npos ? name.substr(end + 1) : name;
}

// The first layer of a kind; none where there is none.
const LayerRow* first_of(const Plan& plan, const std::string& kind) {
  const auto found =
      std::ranges::find_if(plan.rows(), [&](const LayerRow& row) { return row.kind->name == kind; });
  return found == plan.rows().end() ? nullptr : &*found;
}

// A study of layers that are built on the same one: inputs are the layers below and, by their labels, the
// layers; and a flat baseline, as flat_arcs, where there is one to compare with.
void add_comparison(Plan& plan, const std::string& stage, const std::vector<std::string>& names,
                    const char* key, const nlohmann::json& settings, const LayerRow* flat = nullptr) {
  if (names.empty()) return;
  const LayerRow& first = plan.layer(names.front(), key);
  std::map<std::string, std::string> labels;
  if (flat) labels.emplace("flat_arcs", flat->name);
  for (const std::string& name : names)
    if (const auto [other, fresh] = labels.emplace(label(name), name); !fresh)
      plan.fail(
          fmt::format("{}: '{}' and '{}' would both be called '{}'; expected layers that differ in what "
                      "follows the first _",
                      key, other->second, name, other->first));
  for (const std::string& name : names)
    if (plan.layer(name, key).below != first.below)
      plan.fail(fmt::format("{}: '{}' is built on '{}', '{}' on '{}'; expected layers on the same one", key,
                            first.name, first.below, name, plan.layer(name, key).below));
  for (int r = 0; r < plan.replications(first); ++r) {
    Inputs inputs = plan.inputs("below", plan.stack(first.below), r);
    for (const std::string& name : names) inputs.emplace_back(label(name), numbered(name, r));
    if (flat) inputs.emplace_back("flat_arcs", numbered(flat->name, r));
    plan.add(stage, stage, r, with(plan.run(r), settings), inputs);
  }
}

void plan_substitution(Plan& plan) {
  const SubstitutionTable& s = plan.profile().substitution;
  if (s.layer.empty()) return;
  const LayerRow& arcs = plan.layer(s.layer, "substitution.layer", "arcs");
  std::vector<const LayerRow*> original = plan.stack(arcs.name), substitute = original;
  substitute.front() = &plan.layer(s.substitute, "substitution.substitute", "points");
  for (int r = 0; r < plan.replications(arcs); ++r) {
    Inputs inputs = plan.inputs("original", original, r);
    for (const auto& input : plan.inputs("substitute", substitute, r)) inputs.push_back(input);
    plan.add("substitution", "substitution", r, plan.run(r), inputs);
  }
}

// Layer 1 by searches made of other parts, and what they come to on one grid.
void plan_searches(Plan& plan) {
  const SearchesTable& s = plan.profile().searches;
  if (s.replications == 0 || s.variants.empty()) return;
  LayerRow row = plan.layer(s.layer, "searches.layer", "points");
  row.search.generations = s.search.generations;
  Inputs inputs;
  for (const SearchVariant& v : s.variants)
    for (int r = 0; r < s.replications; ++r) {
      const std::string stage = "layer1_search_" + v.name;
      row.search.container = v.search.container;
      row.search.selector = v.search.selector;
      plan.add_layer(stage, row, r, plan.arm(), {});
      inputs.emplace_back(fmt::format("{}/{:02}", v.name, r), numbered(stage, r));
    }
  const ArmTable& arm = plan.profile().arm;
  const JointCost& cost = named(joint_costs(), row.settings["cost"].get<std::string>(), "cost");
  const double worst = -cost.most(arm.joint_limit, static_cast<Eigen::Index>(arm.links.size()));
  plan.add("searches", "searches", -1, {{"passive_cells", s.passive_cells}, {"worst_fitness", worst}},
           inputs);
}

void plan_digits(Plan& plan) {
  const DigitsTable& s = plan.profile().digits;
  if (plan.profile().replications.digits == 0 || s.hierarchy.empty()) return;
  const LayerRow& digits = plan.layer(s.hierarchy, "digits.hierarchy", "digits");
  const LayerRow& flat = plan.layer(s.flat, "digits.flat");
  for (int r = 0; r < plan.replications(digits); ++r) {
    plan.add("digit_verdicts", "digit_verdicts", r, nlohmann::json::object(),
             {{"dataset", "dataset.h5"},
              {"judge", "judge.h5"},
              {"hbr", numbered(s.hierarchy, r)},
              {"flat", numbered(s.flat, r)}});
    Inputs drawn = plan.inputs("layer", plan.stack(s.hierarchy), r);
    drawn.emplace_back("digits", numbered("digit_verdicts", r));
    plan.add("surest_digits", "surest_digits", r, nlohmann::json::object(), drawn);
    if (std::string(flat.kind->name) != "flat_digits") continue;
    drawn.insert(drawn.end(), {{"flat", numbered(s.flat, r)}, plan.descriptor(r)});
    plan.add("digit_turns", "digit_turns", r, nlohmann::json::object(), drawn);
  }
}

void plan_numbers(Plan& plan) {
  const std::string& name = plan.profile().numbers.layer;
  if (plan.profile().replications.digits == 0 || name.empty()) return;
  plan.layer(name, "numbers.layer", "numbers");
  for (int r = 0; r < plan.profile().replications.digits; ++r)
    plan.add_numbers("numbers", plan.inputs("layer", plan.stack(name), r), r);
}

}  // namespace

void plan_studies(Plan& plan) {
  const Profile& p = plan.profile();
  const auto references = std::ranges::count_if(p.accuracy.layers, [&](const std::string& name) {
    return std::string(plan.layer(name, "accuracy.layers").kind->name) == "lines_from_start";
  });
  if (references > 1)
    plan.fail(fmt::format(
        "accuracy.layers has {} layers of the kind lines_from_start; expected at most one, the reference",
        references));
  add_comparison(plan, "accuracy", p.accuracy.layers, "accuracy.layers", {{"requests", p.accuracy.requests}});
  add_comparison(plan, "arc_quality", p.arc_quality.layers, "arc_quality.layers",
                 {{"fresh_starts", p.arc_quality.fresh_starts}}, first_of(plan, "flat_arcs"));
  plan_substitution(plan);
  plan_searches(plan);
  plan_digits(plan);
  plan_numbers(plan);
}

// The digits' stack, with the numbers on top where they stand on these digits.
void plan_explorer(Plan& plan) {
  const Profile& p = plan.profile();
  const int replications = std::min(p.replications.digits, p.explorer.replications);
  if (replications == 0 || p.digits.hierarchy.empty()) return;
  std::vector<const LayerRow*> stack = plan.stack(p.digits.hierarchy);
  if (!p.numbers.layer.empty() && plan.layer(p.numbers.layer, "numbers.layer").below == p.digits.hierarchy)
    stack = plan.stack(p.numbers.layer);
  for (int r = 0; r < replications; ++r) {
    Inputs inputs = plan.inputs("layer", stack, r);
    inputs.insert(inputs.end(), {{"flat", numbered(p.digits.flat, r)},
                                 {"digits", numbered("digit_verdicts", r)},
                                 plan.descriptor(r)});
    plan.add("explorer", "explorer", r, with(plan.run(r), {{"executions", p.explorer.executions}}), inputs);
  }
}

}  // namespace hbr::inline stages
