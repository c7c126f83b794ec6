// What every kind of layer promises, and what each makes of settings that it does not know.
#include <numeric>
#include <set>

#include "pipeline/core/check.h"
#include "pipeline/drawing/draw.h"
#include "pipeline/hierarchy/layers.h"
#include "tests/pipeline/hierarchy/layers.h"

namespace hbr {
namespace {

using nlohmann::json;

// Where the ink is, and how much.
class Ink final : public Descriptor {
 public:
  const Eigen::VectorXf& lower() const override { return lower_; }
  const Eigen::VectorXf& upper() const override { return upper_; }
  void describe(Eigen::Index n, const float* images, float* position, float* error) const override {
    for (Eigen::Index i = 0; i < n; ++i) {
      const Eigen::Map<const Eigen::Matrix<float, kImageSide, kImageSide, Eigen::RowMajor>> image(
          images + i * kImagePixels);
      position[2 * i] = image.topRows<kImageSide / 2>().mean();
      position[2 * i + 1] = image.leftCols<kImageSide / 2>().mean();
      error[i] = image.mean();
    }
  }

 private:
  Eigen::VectorXf lower_ = Eigen::VectorXf::Zero(2), upper_ = Eigen::VectorXf::Ones(2);
};

// Settings of each kind, and how many of the small layers it stands on.
struct Example {
  const char* kind;
  json settings;
  int below;
};

const json kPencil = {{"framing", "box"}, {"thinnest_px", 1.0}, {"thickest_px", 4.0}};
const double kHalf = kFrame.half_side, kRho = kFrame.longest_line;

std::vector<Example> examples() {
  return {
      {"points", {{"half_side", kHalf}, {"cost", "joint_variance"}}, 0},
      {"lines",
       {{"longest_line", kRho},
        {"line_range", "disc"},
        {"samples", 5},
        {"starts", "joints"},
        {"start_draws", "common"}},
       1},
      {"lines_from_start",
       {{"longest_line", kRho}, {"line_range", "square"}, {"starts", "elites"}, {"start_draws", "fresh"}},
       1},
      {"arcs",
       {{"controller", "turn"},
        {"centre", "circle"},
        {"joint_term", "mean"},
        {"turns", "unsigned"},
        {"still_heading", "kept"},
        {"samples", 4},
        {"sample_fitness", "median"},
        {"way_points", "commanded"},
        {"starts", "elites"},
        {"start_draws", "fresh"}},
       2},
      {"flat_arcs",
       {{"half_side", kHalf},
        {"longest_line", kRho},
        {"centre", "circle"},
        {"joint_term", "mean"},
        {"turns", "signed"},
        {"still_heading", "zero"},
        {"start", "first"}},
       0},
      {"digits",
       {{"line_spacing", 0.02},
        {"way_points", "commanded"},
        {"out_of_range", "reject"},
        {"length_rate", 0.1},
        {"pencil", kPencil}},
       3},
      {"numbers", {{"digits", 2}, {"line_spacing", 0.02}, {"way_points", "reached"}, {"pencil", kPencil}}, 4},
      {"flat_digits",
       {{"half_side", kHalf},
        {"pen", "straight"},
        {"start", "first"},
        {"length_rate", 0.1},
        {"pencil", kPencil}},
       0},
  };
}

class Kinds : public Layers {
 protected:
  Stack stack(int levels) {
    Stack stack;
    const LayerKind* kinds[] = {&layer_kind("points"), &layer_kind("lines"), &layer_kind("arcs"),
                                &layer_kind("digits")};
    const std::vector<Example> all = examples();
    for (int level = 0; level < levels; ++level) {
      const auto example =
          std::ranges::find(all, std::string(kinds[level]->name), [](const Example& e) { return e.kind; });
      auto model = kinds[level]->make(example->settings, "example", {arm, level ? &stack : nullptr});
      stack.add(std::move(model), elites(level));
    }
    return stack;
  }
  Elites elites(int level) {
    if (level == 0) return point_elites;
    if (level == 1) return line_elites;
    if (level == 2) return arc_elites;
    Elites digits = some_elites(60, 12, 2, rng);
    for (int i = 0; i < 60; ++i) digits.length.push_back(6 + 3 * (i % 3));
    return digits;
  }
  Batch genomes(const GenomeShape& shape, int n, int descriptor_size) {
    Batch batch(n, shape.genes(), descriptor_size);
    batch.genome = Rows::NullaryExpr(n, shape.genes(), [&] { return rng.uniform(); });
    for (int i = 0; i < n; ++i)
      batch.length[i] = shape.fixed() ? shape.genes() : shape.genes(1 + i % shape.most_blocks);
    return batch;
  }
  Ink ink;
};

TEST_F(Kinds, TheTableHasAnExampleOfEach) {
  EXPECT_EQ(examples().size(), layer_kinds().size());
  for (const Example& example : examples()) {
    const LayerKind& kind = layer_kind(example.kind);
    EXPECT_EQ(kind.built_on_others(), example.below > 0) << kind.name;
    EXPECT_EQ(kind.checked({example.settings, "x", {}, {}}), example.settings) << kind.name;
    std::vector<std::string> keys;
    for (const auto& [key, value] : example.settings.items()) keys.push_back(key);
    EXPECT_EQ(kind.keys(), keys) << kind.name;
    json unknown = example.settings;
    unknown["spede"] = 1;
    EXPECT_THROW(kind.checked({unknown, "x", {}, {}}), InputError) << kind.name;
  }
  EXPECT_THROW(layer_kind("spirals"), InputError);
}

// A row depends on its genome and its seed alone; what has a behaviour is finite and lies within the range.
TEST_F(Kinds, EvaluateRowByRow) {
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.kind);
    const Stack below = stack(example.below);
    const auto model = layer_kind(example.kind)
                           .make(example.settings, "example", {arm, example.below ? &below : nullptr, &ink});
    const Evaluator& evaluator = model->evaluator();
    Batch whole = genomes(model->genome(), 40, evaluator.descriptor_size()), parts = whole;
    evaluator.evaluate(whole, 0, 40, Seed(3));
    evaluator.evaluate(parts, 0, 7, Seed(3));
    evaluator.evaluate(parts, 7, 40, Seed(3));
    EXPECT_EQ(whole.valid, parts.valid);
    int valid = 0;
    for (int i = 0; i < 40; ++i) {
      if (!whole.valid[i]) continue;
      ++valid;
      EXPECT_EQ(whole.descriptor.row(i), parts.descriptor.row(i));
      EXPECT_EQ(whole.fitness[i], parts.fitness[i]);
      EXPECT_EQ(whole.uncertainty[i], parts.uncertainty[i]);
      EXPECT_TRUE(std::isfinite(whole.fitness[i]));
      EXPECT_GE(whole.descriptor.row(i).minCoeff(), model->low() - 0.3f);
      EXPECT_LE(whole.descriptor.row(i).maxCoeff(), model->high() + 0.3f);
    }
    EXPECT_GT(valid, 5);
    Batch again = whole;
    evaluator.evaluate(again, 0, 40, Seed(4));
    EXPECT_TRUE(!evaluator.deterministic() || again.fitness == whole.fitness);
    EXPECT_TRUE(evaluator.deterministic() || !evaluator.stochastic() || again.descriptor != whole.descriptor);
  }
}

// Every number of genome and descriptor is told, under a name of its own, and so is the fitness.
TEST_F(Kinds, TellWhatTheirNumbersAre) {
  for (const Example& example : examples()) {
    SCOPED_TRACE(example.kind);
    const Stack below = stack(example.below);
    const auto model = layer_kind(example.kind)
                           .make(example.settings, "example", {arm, example.below ? &below : nullptr, &ink});
    EXPECT_EQ(static_cast<int>(model->descriptor().size()), model->evaluator().descriptor_size());
    EXPECT_EQ(static_cast<int>(model->genome().coordinates().size()), model->genome().genes());
    EXPECT_FALSE(model->fitness().meaning.empty());
    for (const Coordinates& coordinates : {model->genome().coordinates(), model->descriptor()}) {
      std::set<std::string> names;
      for (const Coordinate& c : coordinates) {
        EXPECT_TRUE(names.insert(c.name).second) << c.name;
        EXPECT_LT(c.low, c.high) << c.name;
      }
    }
  }
}

// A finished layer answers by the nearest elite, and has an execution do what that elite's genome does.
TEST_F(Kinds, ObeyByTheirElites) {
  for (const Example& example : examples()) {
    if (example.below == 0) continue;
    SCOPED_TRACE(example.kind);
    const Stack below = stack(example.below);
    const auto model = layer_kind(example.kind).make(example.settings, "example", {arm, &below, &ink});
    const GenomeShape shape = model->genome();
    const int size = model->evaluator().descriptor_size();
    Elites elites = some_elites(50, shape.genes(), size, rng);
    const Batch some = genomes(shape, 50, size);
    if (!shape.fixed()) elites.length = some.length;
    const auto layer = model->finished(elites);
    ASSERT_EQ(layer->command_size(), size);
    ASSERT_EQ(layer->size(), 50);

    const Rows commands = Rows::NullaryExpr(size, 30, [&] { return rng.uniform(-0.1f, 1.1f); });
    std::vector<const float*> coordinates;
    for (int d = 0; d < size; ++d) coordinates.push_back(commands.row(d).data());
    std::vector<std::int32_t> answers(30), start{17};
    layer->nearest(30, coordinates.data(), answers.data());
    const Executor once(below.points(), below.top(), model->executor()->decoder(), 1, {true, 0});
    for (int i = 0; i < 30; ++i) {
      ASSERT_EQ(answers[i], plain_nearest(elites.measures, commands.col(i).cast<double>()));
      Executions by_layer, by_genome;
      by_layer.begin(below.points(), 1, {true, 0});
      by_layer.move(by_layer.all(), start.data());
      layer->perform(by_layer, by_layer.all(), &answers[i]);
      std::uint8_t possible = 0;
      once.execute(elites.solution, elites.length.empty() ? nullptr : elites.length.data(), answers[i],
                   answers[i] + 1, Seed(5), by_genome, &possible);
      // Where a genome begins is another matter: displacements are compared where it goes on from anywhere.
      if (!possible || !model->executor()->decoder().places()) continue;
      const std::vector<std::int32_t> way(by_layer.way(0).begin() + 1, by_layer.way(0).end());
      EXPECT_EQ(way, by_genome.way(0));
    }
  }
}

TEST_F(Kinds, DrawWithinTheRangeOfInk) {
  for (const Example& example : examples()) {
    const Stack below = stack(example.below);
    const auto model = layer_kind(example.kind)
                           .make(example.settings, "example", {arm, example.below ? &below : nullptr, &ink});
    EXPECT_EQ(model->images() > 0, layer_kind(example.kind).learned) << example.kind;
    const Batch batch = genomes(model->genome(), 5, 1);
    for (int i = 0; i < 5 && model->images() > 0; ++i) {
      std::vector<float> images(model->images() * kImagePixels, -1.0f);
      model->draw(batch.genome.row(i).data(), batch.length[i], images.data());
      for (const float pixel : images) {
        EXPECT_GE(pixel, 0);
        EXPECT_LE(pixel, 1.0001f);
      }
    }
  }
}

TEST_F(Kinds, StandOnWhatAnswersToThem) {
  const char* stack[] = {"points", "lines", "arcs", "digits", "numbers"};
  for (int below = 0; below < 5; ++below)
    for (int above = 0; above < 5; ++above)
      EXPECT_EQ(layer_kind(stack[above]).stands_on(layer_kind(stack[below])), above == below + 1);
  for (const LayerKind& kind : layer_kinds()) {
    EXPECT_FALSE(kind.stands_on(layer_kind("flat_digits"))) << kind.name;
    EXPECT_FALSE(kind.stands_on(layer_kind("lines_from_start"))) << kind.name;
  }
  EXPECT_THROW(Stack().points(), InputError);
  Stack flat;
  const json settings = examples()[4].settings;
  EXPECT_THROW(flat.add(layer_kind("flat_arcs").make(settings, "x", {arm}), point_elites), InputError);
}

}  // namespace
}  // namespace hbr
