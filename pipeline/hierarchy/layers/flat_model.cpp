#include "pipeline/hierarchy/layers/flat_model.h"

#include "pipeline/core/check.h"

namespace hbr::inline hierarchy {
namespace {

class FlatModel final : public LayerModel {
 public:
  FlatModel(const char* kind, FlatParts parts) : kind_(kind), parts_(std::move(parts)) {}
  GenomeShape genome() const override { return parts_.genome; }
  const Evaluator& evaluator() const override {
    HBR_CHECK(parts_.evaluator, "{} without a descriptor are not evolved", kind_);
    return *parts_.evaluator;
  }
  float low() const override { return parts_.low; }
  float high() const override { return parts_.high; }
  const Coordinates& descriptor() const override { return parts_.descriptor; }
  const FitnessMeaning& fitness() const override { return parts_.fitness; }
  const Frame& frame() const override { return parts_.frame; }
  std::unique_ptr<Layer> finished(const Elites&) const override {
    throw InputError("no layer can be built on {}: they move the joints, not a pen that goes on", kind_);
  }
  int images() const override { return parts_.images; }
  void draw(const float* genome, int length, float* images) const override {
    if (parts_.draw) parts_.draw(genome, length, images);
  }

 private:
  const char* kind_;
  FlatParts parts_;
};

}  // namespace

std::unique_ptr<LayerModel> flat_model(const char* kind, FlatParts parts) {
  return std::make_unique<FlatModel>(kind, std::move(parts));
}

}  // namespace hbr::inline hierarchy
