// How the arm draws: of each class the digits that the judge is surest of, joint by joint.
#include "models/arm/planar_arm.h"
#include "models/judge/surest.h"
#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/core/check.h"
#include "pipeline/hierarchy/trace.h"
#include "stages/layers/read_stack.h"

namespace {

void run(hbr::StageRun& stage) {
  const hbr::StackOnBody arm = hbr::read_stack(stage, "layer");
  const hbr::LayerModel& model = arm.top();
  const hbr::Elites& digits = arm.elites.back();
  const hbr::Hdf5Reader judged(stage.input("digits"));
  const hbr::JudgedDigits said{judged.read<std::uint8_t>("hbr/label").values,
                               judged.read<std::uint8_t>("hbr/good").values,
                               judged.read<float>("hbr/confidence").values};
  const auto& [label, good, confidence] = said;
  const auto n = static_cast<std::size_t>(digits.size());
  if (judged.read<std::int64_t>("hbr/id").values != digits.id || label.size() != n || good.size() != n ||
      confidence.size() != n)
    throw hbr::InputError("{}: judges other digits than the {} of {}; make it again", judged.path().string(),
                          n, stage.name());

  std::vector<std::uint8_t> shown_label, shown_good;
  std::vector<std::int64_t> id;
  std::vector<std::int32_t> count;
  std::vector<float> pen, joints;
  for (const std::size_t i : hbr::surest_of_each_class(said)) {
    const auto row = static_cast<Eigen::Index>(i);
    const hbr::Trace trace = trace_of(*model.executor(), digits.solution.row(row).data(), digits.genes(row));
    if (trace.points() == 0) continue;
    shown_label.push_back(label[i]);
    shown_good.push_back(good[i]);
    id.push_back(digits.id[row]);
    count.push_back(static_cast<std::int32_t>(trace.points()));
    pen.insert(pen.end(), trace.pen.begin(), trace.pen.end());
    joints.insert(joints.end(), trace.joints.begin(), trace.joints.end());
  }

  hbr::Hdf5Writer file(stage.output());
  stage.write_settings(file);
  file.write("label", shown_label);
  file.write("good", shown_good);
  file.write("id", id);
  file.write("points", count);
  file.write("pen", {pen.size() / 2, 2}, pen.data());
  file.write("joints", {pen.size() / 2, static_cast<std::size_t>(arm.body->dof())}, joints.data());
  if (const auto* planar = dynamic_cast<const hbr::PlanarArm*>(arm.body.get()))
    file.write("links", std::vector<float>(planar->links().begin(), planar->links().end()));
  file.close();
}

}  // namespace

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "How the arm draws its digits", run); }
