#include "pipeline/qd/selectors.h"

#include "pipeline/qd/named.h"
#include "pipeline/qd/score_selectors.h"

namespace hbr::inline qd {
namespace {

template <class S>
std::unique_ptr<Selector> plain(const SelectorSettings&) {
  return std::make_unique<S>();
}

template <class S>
std::unique_ptr<Selector> by_local_scores(const SelectorSettings& s) {
  return std::make_unique<S>(make_local_scores(s.descriptor_size, s.neighbours, s.low, s.high));
}

constexpr SelectorKind kSelectors[] = {
    {"curiosity", "by what became of an elite's children", plain<CuriositySelector>},
    {"uniform", "every elite alike", plain<UniformSelector>},
    {"fitness", "in proportion to the fitness", plain<FitnessSelector>},
    {"novelty", "in proportion to the novelty", by_local_scores<NoveltySelector>},
    {"nslc", "Pareto fronts of novelty and local competition", by_local_scores<NslcSelector>},
};

}  // namespace

std::span<const SelectorKind> selector_kinds() { return kSelectors; }
const SelectorKind& selector_kind(const std::string& name) { return named(kSelectors, name, "selector"); }

}  // namespace hbr::inline qd
