#include "pipeline/hierarchy/stacked_model.h"

#include <algorithm>

#include "pipeline/core/check.h"
#include "pipeline/drawing/draw.h"
#include "pipeline/hierarchy/repertoire_layer.h"
#include "pipeline/hierarchy/stack.h"

namespace hbr::inline hierarchy {
namespace {

class StackedModel final : public LayerModel {
 public:
  StackedModel(const Stack& below, StackedParts parts)
      : parts_(std::move(parts)),
        below_(below.top()),
        executor_(below.points(), below_, *parts_.decoder, parts_.samples, parts_.way, parts_.starts) {
    if (parts_.outcome)
      evaluator_ = std::make_unique<SingleEvaluator>(executor_, *parts_.outcome);
    else if (parts_.sampled)
      evaluator_ = std::make_unique<SampledEvaluator>(executor_, *parts_.sampled, parts_.sample_fitness);
    HBR_CHECK(!outcome() || outcome()->descriptor_size() == static_cast<int>(parts_.descriptor.size()),
              "{} coordinates of the descriptor are told; expected {}", parts_.descriptor.size(),
              outcome()->descriptor_size());
  }

  GenomeShape genome() const override { return parts_.genome; }
  const Evaluator& evaluator() const override {
    HBR_CHECK(evaluator_, "a layer without an outcome is only executed");
    return *evaluator_;
  }
  float low() const override { return outcome() ? outcome()->low() : 0; }
  float high() const override { return outcome() ? outcome()->high() : 1; }
  const Coordinates& descriptor() const override { return parts_.descriptor; }
  const FitnessMeaning& fitness() const override { return parts_.fitness; }
  const Frame& frame() const override { return parts_.frame; }
  std::unique_ptr<Layer> finished(const Elites& elites) const override {
    return std::make_unique<RepertoireLayer>(elites, *parts_.decoder, executor_.points(), below_,
                                             parts_.slack);
  }
  const Executor* executor() const override { return &executor_; }
  const SampledOutcome* sampled_outcome() const override { return parts_.sampled.get(); }
  int images() const override { return parts_.images; }
  void draw(const float* genome, int length, float* images) const override {
    Rows rows = Eigen::Map<const Rows>(genome, 1, length);
    std::uint8_t possible = 0;
    Executions executions;
    executor_.execute(rows, nullptr, 0, 1, Seed(0), executions, &possible);
    std::fill_n(images, parts_.images * kImagePixels, 0.0f);
    if (possible) parts_.draw(executions, 0, images);
  }

 private:
  const Outcome* outcome() const { return parts_.sampled ? parts_.sampled.get() : parts_.outcome.get(); }

  StackedParts parts_;
  const Layer& below_;
  Executor executor_;
  std::unique_ptr<Evaluator> evaluator_;
};

}  // namespace

std::unique_ptr<LayerModel> stacked_model(const Surroundings& around, StackedParts parts) {
  HBR_CHECK(around.below, "a layer that is built on others, without any");
  return std::make_unique<StackedModel>(*around.below, std::move(parts));
}

}  // namespace hbr::inline hierarchy
