// Evolves a layer of any kind, over the layers below it; or lets one go on to evolve where what is below it
// has changed (paper, section 5.2, as an outlook).
#include "pipeline/artifact/run_settings.h"
#include "pipeline/core/check.h"
#include "pipeline/hierarchy/layers.h"
#include "stages/layers/body.h"
#include "stages/layers/description.h"
#include "stages/layers/evolve.h"
#include "stages/layers/images.h"
#include "stages/layers/read_stack.h"
#include "stages/layers/warm_start.h"
#include "stages/learned/descriptors.h"

namespace hbr::inline stages {
namespace {

struct LayerSlice : RunTable {
  std::string kind;
  nlohmann::json layer, body;
  SearchTable search;
  std::int64_t more = 0;
};
template <class Fields>
void describe(Fields& f, LayerSlice& s) {
  describe_run(f, s);
  f.choice("kind", s.kind, names_of(layer_kinds()), "of layer");
  f.raw_table("layer", s.layer, "the settings of its kind");
  f.raw_table("body", s.body, "whose joints it moves; empty where it is built on other layers");
  f.table("search", s.search, "the search, which counts all generations");
  f.number("more", s.more, Range{0, 1e9},
           "of its generations, those done here by elites that others have evolved until then; 0: all");
}

void run(StageRun& stage) {
  const auto s = stage.settings_as<LayerSlice>();
  const LayerKind& kind = layer_kind(s.kind);
  StackOnBody below;
  if (kind.built_on_others())
    below = read_stack(stage, "below");
  else
    below.body = make_body(s.body, stage.name(), stage);
  std::unique_ptr<Descriptor> descriptor;
  if (kind.learned) descriptor = load_descriptor(stage.input("descriptor"));
  const auto model =
      kind.make(s.layer, stage.name(),
                {*below.body, kind.built_on_others() ? &below.stack : nullptr, descriptor.get()});

  const auto variation = make_variation(model->genome(), s.search);
  const Seed seed = seed_of(stage, s);
  const DescriptorRange range{model->low(), model->high()};
  const auto more = [&](Hdf5Writer& file, const Elites& elites) {
    write_description(file, *model);
    if (model->images() == 0) return;
    Workers workers(stage.threads());
    write_images(file, *model, elites, workers);
  };
  if (s.more > 0)
    evolve_on(stage, s.search, s.more, read_elites(stage.input("elites")), *variation, model->evaluator(),
              seed, range, more);
  else
    evolve(stage, s.search, *variation, model->evaluator(), seed, range, more);
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "Evolves a layer", hbr::run); }
