#include "pipeline/hierarchy/layers.h"

#include "pipeline/hierarchy/layers/arcs.h"
#include "pipeline/hierarchy/layers/digits.h"
#include "pipeline/hierarchy/layers/flat_arcs.h"
#include "pipeline/hierarchy/layers/flat_digits.h"
#include "pipeline/hierarchy/layers/lines.h"
#include "pipeline/hierarchy/layers/numbers.h"
#include "pipeline/hierarchy/layers/points.h"
#include "pipeline/qd/named.h"

namespace hbr::inline hierarchy {
namespace {

constexpr bool kLearned = true, kByHand = false;

constexpr LayerKind kKinds[] = {
    layer_kind<PointsSettings, make_points>("points", "places of the pen, by joint angles", "places", "",
                                            kByHand),
    layer_kind<LinesSettings, make_lines>("lines", "displacements of the pen, by a displacement",
                                          "displacements", "places", kByHand),
    layer_kind<LinesFromStartSettings, make_lines_from_start>(
        "lines_from_start", "the same, described also by where they begin, without samples",
        "displacements from places", "places", kByHand),
    layer_kind<ArcsSettings, make_arcs>("arcs", "arcs, by five lines", "arcs", "displacements", kByHand),
    layer_kind<FlatArcsSettings, make_flat_arcs>("flat_arcs", "arcs, by five configurations of all joints",
                                                 "nothing", "", kByHand),
    layer_kind<DigitsSettings, make_digits>("digits", "digits, by a place and one to three arcs", "digits",
                                            "arcs", kLearned),
    layer_kind<FlatDigitsSettings, make_flat_digits>(
        "flat_digits", "digits, by five to fifteen configurations of all joints", "nothing", "", kLearned),
    layer_kind<NumbersSettings, make_numbers>("numbers", "some digits from left to right", "numbers",
                                              "digits", kLearned),
};

}  // namespace

std::span<const LayerKind> layer_kinds() { return kKinds; }

const LayerKind& layer_kind(const std::string& name) { return named(kKinds, name, "kind of layer"); }

}  // namespace hbr::inline hierarchy
