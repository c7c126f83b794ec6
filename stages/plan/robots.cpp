// What the robots do: where they draw, their points, and the digits of the arm over these.
#include "stages/plan/robot_inputs.h"

namespace hbr::inline stages {
namespace {

void plan_points(Plan& plan, const RobotSettings& robot, const nlohmann::json& body) {
  const Profile& p = plan.profile();
  LayerRow points = *transferred(plan).front();
  const double half_side = points.settings["half_side"];
  plan.add("robot_plane", robot.name + "_plane", -1,
           {{"seed", p.seed},
            {"half_side", half_side},
            {"robot", settings_to_json(robot)},
            {"search", settings_to_json(p.robot_plane)}},
           {{"layer1", numbered(points.name, 0)}}, {robot.urdf});
  const std::string arm_points = points.name;
  points.search.generations = p.robot_layer1.generations;
  points.search.spacing = p.robot_layer1.spacing;
  points.search.epsilon = p.robot_layer1.epsilon;
  for (int r = 0; r < p.replications.digits; ++r) {
    plan.add_layer(robot.name + "_layer1", points, r, body, plane(&robot), {robot.urdf});
    Inputs inputs = plane(&robot);
    append(inputs,
           {{"robot_layer1", numbered(robot.name + "_layer1", r)}, {"layer1", numbered(arm_points, r)}});
    plan.add("project_onto_plane", robot.name + "_projected", r,
             with(plan.run(r), {{"kind", points.kind->name},
                                {"layer", points.settings},
                                {"body", body},
                                {"spacing", points.search.spacing}}),
             inputs, {robot.urdf});
  }
}

void plan_transfer(Plan& plan, const RobotRow& robot) {
  const Profile& p = plan.profile();
  const bool stands = !robot.stands_on.empty();  // on what it looks like
  auto gears = nlohmann::json::array();
  for (const GearSettings& gear : robot.gears) gears.push_back(settings_to_json(gear));
  const auto stack = transferred(plan);
  for (int r = 0; r < p.replications.digits; ++r) {
    Inputs by_robot = over(plan, "robot", stack, &robot, r);
    append(by_robot, plane(&robot));
    Inputs both = plan.inputs("arm", stack, r), evolved = plan.inputs("evolved", stack, r);
    evolved.front().second = numbered(robot.name + "_layer1", r);
    append(both, by_robot);
    append(both, evolved);
    append(both,
           {{"digits", numbered("digit_verdicts", r)}, {"dataset", "dataset.h5"}, {"judge", "judge.h5"}});
    plan.add("robot_transfer", robot.name + "_transfer", r,
             with(plan.run(r), {{"transfer", settings_to_json(p.transfer)},
                                {"spacing", p.robot_layer1.spacing},
                                {"pencil", stack.back()->settings["pencil"]}}),
             both, {robot.urdf});
    append(by_robot, {{"dataset", "dataset.h5"}, {"judge", "judge.h5"}});
    if (stands) append(by_robot, meshes_of(plan, robot));
    plan.add("robot_dynamics", robot.name + "_dynamics", r,
             with(plan.run(r), {{"dynamics", settings_to_json(p.dynamics)},
                                {"robot", settings_to_json<RobotSettings>(robot)},
                                {"gears", gears},
                                {"pencil", stack.back()->settings["pencil"]}}),
             by_robot, stands ? looks_of(robot) : std::vector<std::string>{robot.urdf});
  }
}

void plan_numbers(Plan& plan, const RobotSettings& robot) {
  const std::string& name = plan.profile().numbers.layer;
  if (name.empty()) return;
  for (int r = 0; r < plan.profile().replications.digits; ++r) {
    Inputs inputs = over(plan, "layer", plan.stack(name), &robot, r);
    append(inputs, plane(&robot));
    plan.add_numbers(robot.name + "_numbers", inputs, r, {robot.urdf});
  }
}

void plan_picture(Plan& plan, const RobotSettings& robot) {
  Inputs inputs{{"plane", robot.name + "_plane.h5"}, {"transfer", numbered(robot.name + "_transfer", 0)}};
  append(inputs, meshes_of(plan, robot));
  plan.add({"robot_picture",
            robot.name + "_picture",
            -1,
            robot.name + "_picture",
            {{"half_side", transferred(plan).front()->settings["half_side"]},
             {"height", plan.profile().robot_picture.height},
             {"robot", settings_to_json(robot)}},
            inputs,
            looks_of(robot)});
}

// The arm's layers evolve on over a robot; over none, over the arm itself, which is the control.
void plan_tuning(Plan& plan, const std::string& name, const RobotSettings* robot) {
  const Profile& p = plan.profile();
  const auto stack = transferred(plan);
  if (stack.size() != 4 || stack[1]->kind->name != std::string("lines") ||
      stack[2]->kind->name != std::string("arcs"))
    plan.fail("digits.hierarchy: fine-tuning expects digits on arcs on lines on points");
  const LayerRow &lines = *stack[1], &arcs = *stack[2], &digits = *stack[3];
  const std::vector<std::string> urdf = robot ? std::vector{robot->urdf} : std::vector<std::string>{};
  const auto tuned = [&](const char* layer, int r) { return numbered(name + "_tuned_" + layer, r); };
  for (int r = 0; r < p.replications.digits; ++r) {
    // The layers below, of which those from `own` on evolved on by themselves.
    const auto below = [&](std::size_t levels, bool own, const char* input = "below") {
      Inputs inputs =
          over(plan, input, {stack.begin(), stack.begin() + static_cast<std::ptrdiff_t>(levels)}, robot, r);
      if (own && levels > 1) inputs[1].second = tuned("lines", r);
      if (own && levels > 2) inputs[2].second = tuned("arcs", r);
      return inputs;
    };
    const auto evolve_on = [&](const char* layer, const LayerRow& row, Inputs inputs, std::int64_t more) {
      append(inputs, plane(robot));
      inputs.emplace_back("elites", numbered(row.name, r));
      plan.add_layer(name + "_tuned_" + layer, row, r, {}, inputs, urdf, more);
    };
    evolve_on("lines", lines, below(1, true), p.tuning.line_generations);
    evolve_on("arcs", arcs, below(2, true), p.tuning.arc_generations);
    evolve_on("top", digits, below(3, false), p.tuning.digit_generations);
    evolve_on("all", digits, below(3, true), p.tuning.digit_generations);

    Inputs drawn = plan.inputs("arm", stack, r);
    append(drawn, below(4, false, "before"));
    append(drawn, below(3, true, "after"));
    append(drawn, plane(robot));
    append(drawn, {{"top", tuned("top", r)},
                   {"all", tuned("all", r)},
                   plan.descriptor(r),
                   {"dataset", "dataset.h5"},
                   {"judge", "judge.h5"}});
    plan.add("robot_tuned", name + "_tuned", r,
             with(plan.run(r), {{"transfer", settings_to_json(p.transfer)},
                                {"line_places", lines.search.spacing},
                                {"arc_places", arcs.search.spacing}}),
             drawn, urdf);
  }
}

}  // namespace

void plan_robots(Plan& plan) {
  const Profile& p = plan.profile();
  if (p.replications.digits == 0 || p.robots.empty() || p.digits.hierarchy.empty()) return;
  for (const RobotRow& robot : p.robots) {
    plan_points(plan, robot, {{"robot", settings_to_json<RobotSettings>(robot)}});
    plan_transfer(plan, robot);
    plan_numbers(plan, robot);
    plan_picture(plan, robot);
    plan_tuning(plan, robot.name, &robot);
  }
  plan_tuning(plan, "arm", nullptr);
}

}  // namespace hbr::inline stages
