// What the layers tell of their numbers, held against what these do: values are taken from the description,
// and what they bring about is worked out once more from them.
#include <complex>
#include <set>

#include "pipeline/hierarchy/layers/arcs.h"
#include "pipeline/hierarchy/layers/digits.h"
#include "pipeline/hierarchy/layers/flat_arcs.h"
#include "pipeline/hierarchy/layers/flat_digits.h"
#include "pipeline/hierarchy/layers/image_outcome.h"
#include "pipeline/hierarchy/layers/numbers.h"
#include "tests/pipeline/hierarchy/layers.h"

namespace hbr {
namespace {

// In the unit of each, of what is stored in [least, greatest].
std::vector<double> values(const Coordinates& coordinates, const float* stored, double least = 0,
                           double greatest = 1) {
  std::vector<double> all;
  for (const Coordinate& c : coordinates)
    all.push_back(c.low + (*stored++ - least) / (greatest - least) * (c.high - c.low));
  return all;
}

Eigen::Vector2d at(const std::vector<double>& values, std::size_t i) { return {values[i], values[i + 1]}; }

class CoordinatesOf : public Layers {
 protected:
  std::vector<float> genes(std::size_t n) {
    std::vector<float> some(n);
    for (float& gene : some) gene = rng.uniform();
    return some;
  }
  Batch evaluated(const LayerModel& model, int n) {
    const int genes = model.genome().genes();
    Batch batch(n, genes, model.evaluator().descriptor_size());
    batch.genome = Rows::NullaryExpr(n, genes, [&] { return rng.uniform(); });
    batch.length.assign(n, genes);
    model.evaluator().evaluate(batch, 0, n, Seed(1));
    return batch;
  }
  Eigen::Vector2d pen_of(const double* joints) const {
    Pen pen;
    arm.pens(1, joints, &pen);
    return pen.position;
  }
  const Frame& frame = kFrame;
};

TEST_F(CoordinatesOf, PointsAreJointsAndTheirPlace) {
  const auto model = make_points({frame.half_side, "joint_variance"}, {arm});
  const Coordinates of_genes = model->genome().coordinates();
  const Batch batch = evaluated(*model, 50);
  for (int i = 0; i < 50; ++i) {
    const std::vector<double> joints = values(of_genes, batch.genome.row(i).data()),
                              place = values(model->descriptor(), batch.descriptor.row(i).data());
    EXPECT_LT((at(place, 0) - pen_of(joints.data())).norm(), 1e-6);
    EXPECT_NEAR(batch.fitness[i], -joint_variance(joints.data(), arm.dof()), 1e-6);
  }
  EXPECT_EQ(model->fitness().meaning, "minus the population variance of the joints");
  EXPECT_EQ(make_points({frame.half_side, "few_joints"}, {arm})->fitness().meaning,
            "minus the sum of the squares of all joints but the two largest");
}

TEST_F(CoordinatesOf, LinesAreDisplacements) {
  const Stack below = points();
  const auto model = make_lines_from_start({frame.longest_line, "disc"}, {arm, &below});
  const Batch batch = evaluated(*model, 50);
  for (int i = 0; i < 50; ++i) {
    const std::vector<double> wanted = values(model->genome().coordinates(), batch.genome.row(i).data()),
                              drawn = values(model->descriptor(), batch.descriptor.row(i).data());
    const int start = plain_nearest(point_elites.measures, frame.point_descriptor(at(drawn, 0)));
    EXPECT_LT((at(drawn, 0) - pen(start)).norm(), 1e-5);
    const int end = plain_line_end(start, at_most(at(wanted, 0), frame.longest_line));
    EXPECT_LT((at(drawn, 2) - (pen(end) - pen(start))).norm(), 1e-5);
  }
  const auto lines = make_lines({{frame.longest_line, "disc"}, 3}, {arm, &below});
  ASSERT_EQ(lines->descriptor().size(), 2u);
  EXPECT_EQ(lines->descriptor()[1].name, model->descriptor()[3].name);
  EXPECT_EQ(lines->descriptor()[1].high, model->descriptor()[3].high);
}

TEST_F(CoordinatesOf, ArcsAreDisplacementsAndWhatCircleTheyMake) {
  using Complex = std::complex<double>;
  for (const ArcController& controller : arc_controllers()) {
    const Coordinates of_genes = controller.genes(frame);
    for (int i = 0; i < 50; ++i) {
      const std::vector<float> genome = genes(of_genes.size());
      const std::vector<double> value = values(of_genes, genome.data());
      const ArcLines lines = controller.decode(frame, genome.data());
      for (std::size_t k = 0; k < kArcSegments; ++k) {
        const auto turned = [&] {
          const Complex end = std::polar(value[1], value[0] + static_cast<double>(k) * value[2]);
          return Eigen::Vector2d(end.real(), end.imag());
        };
        const Eigen::Vector2d expected =
            value.size() == 3 ? turned() : at_most(at(value, 2 * k), frame.longest_line);
        EXPECT_LT((lines[k] - expected).norm(), 1e-6) << controller.name << ' ' << k;
      }
    }
  }
  for (int i = 0; i < 50; ++i) {
    ArcPoints drawn;
    for (auto& p : drawn) p = 0.1 * Eigen::Vector2d(rng.uniform(), rng.uniform());
    const ArcShape shape = arc_shape(drawn);
    const Eigen::Vector3f descriptor = arc_descriptor(frame, shape).cast<float>();
    const std::vector<double> told = values(arc_coordinates(frame), descriptor.data());
    EXPECT_LT((at(told, 0) - at_most(shape.centre, frame.half_side)).norm(), 1e-5);
    EXPECT_NEAR(told[2], std::min(shape.length, longest_arc(frame)), 1e-5);
  }
}

TEST_F(CoordinatesOf, FlatArcsAreConfigurations) {
  const auto model =
      make_flat_arcs({{"centroid", "mean"}, frame.half_side, frame.longest_line, "first"}, {arm});
  const Batch batch = evaluated(*model, 30);
  for (int i = 0; i < 30; ++i) {
    const std::vector<double> joints = values(model->genome().coordinates(), batch.genome.row(i).data()),
                              arc = values(model->descriptor(), batch.descriptor.row(i).data());
    std::vector<Eigen::Vector2d> drawn;
    for (std::size_t k = 0; k < kArcSegments; ++k) drawn.push_back(pen_of(&joints[k * 8]));
    const ArcShape shape = arc_shape(drawn, ArcCentre::kCentroid);
    EXPECT_LT((at(arc, 0) - at_most(shape.centre, frame.half_side)).norm(), 1e-5);
    EXPECT_NEAR(arc[2], std::min(shape.length, longest_arc(frame)), 1e-5);
  }
}

TEST_F(CoordinatesOf, DigitsAreAPlaceAWidthAndArcs) {
  const PencilSettings pencil{"box", 1, 4};
  const Stack below = arcs();
  const auto model = make_digits({0.02, "radius", 0.1, pencil}, {arm, &below});
  const GenomeShape shape = model->genome();
  ASSERT_EQ(shape.head.size(), static_cast<std::size_t>(DigitDecoder::kHead));
  ASSERT_EQ(shape.block.size(), static_cast<std::size_t>(DigitDecoder::kBlock));
  EXPECT_TRUE(model->descriptor().empty());  // without the learned one
  const DigitDecoder decoder(below.frame(), OutOfRange::kRadius);
  for (int i = 0; i < 50; ++i) {
    const std::vector<float> genome = genes(shape.genes());
    const std::vector<double> value = values(shape.coordinates(), genome.data());
    const PenPlacement placement = decoder.placement(genome.data()).value();
    EXPECT_LT((placement.place - at(value, 0)).norm(), 1e-6);
    EXPECT_NEAR(pencil.width(placement.width), value[2], 1e-6);
    std::vector<double> commands(9);
    ASSERT_EQ(decoder.decode(genome.data(), shape.genes(), commands.data()), 3);
    const std::vector<float> stored(commands.begin(), commands.end());
    for (std::size_t k = 0; k < 3; ++k) {
      const std::vector<double> asked = values(arc_coordinates(frame), &stored[3 * k]);
      EXPECT_LT((at(asked, 0) - at_most(at(value, 3 + 3 * k), frame.half_side)).norm(), 1e-6);
      EXPECT_NEAR(asked[2], value[5 + 3 * k], 1e-6);
    }
  }
  const auto flat = make_flat_digits({frame.half_side, "straight", "first", 0.1, pencil}, {arm});
  const FlatDigits digits(arm, frame, pencil);
  EXPECT_EQ(flat->genome().genes(0), FlatDigits::kHead);
  EXPECT_EQ(flat->genome().block_genes(), digits.block());
  EXPECT_EQ(flat->genome().block[8].name, "configuration 2 joint 1");
  EXPECT_EQ(flat->genome().head[0].high, 4);
}

TEST_F(CoordinatesOf, NumbersArePlacesInTheLatentSpaceAndOnThePaper) {
  const NumberDecoder decoder(frame, 2, 3, -4, 5);
  const Coordinates told = decoder.genes();
  ASSERT_EQ(told.size(), 10u);
  std::set<std::string> names;
  for (const Coordinate& c : told) names.insert(c.name);
  EXPECT_EQ(names.size(), told.size());
  for (int i = 0; i < 50; ++i) {
    const std::vector<float> genome = genes(told.size());
    const std::vector<double> value = values(told, genome.data());
    std::vector<double> commands(6);
    ASSERT_EQ(decoder.decode(genome.data(), 10, commands.data()), 2);
    for (int k = 0; k < 2; ++k) {
      for (int d = 0; d < 3; ++d) EXPECT_NEAR(commands[3 * k + d], value[5 * k + d], 1e-6);
      EXPECT_LT((decoder.displacement(genome.data(), k) - at(value, 5 * k + 3)).norm(), 1e-6);
    }
  }
}

}  // namespace
}  // namespace hbr
