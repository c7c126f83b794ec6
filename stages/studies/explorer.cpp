// What the report's explorer shows of a replication: the layers' elites with the ways that they take through
// layer 1, the digits with what the descriptor and the judge make of them.
#include "models/arm/planar_arm.h"
#include "pipeline/artifact/run_settings.h"
#include "pipeline/artifact/unit_columns.h"
#include "pipeline/core/check.h"
#include "pipeline/core/parallel.h"
#include "pipeline/drawing/draw.h"
#include "pipeline/hierarchy/executor.h"
#include "stages/layers/read_stack.h"
#include "stages/learned/descriptors.h"

namespace hbr::inline stages {
namespace {

struct ExplorerSlice : RunTable {
  int executions = 0;
};
template <class Fields>
void describe(Fields& f, ExplorerSlice& s) {
  describe_run(f, s);
  f.number("executions", s.executions, Range{1, 100}, "of each line and arc, from random starts");
}

template <class T>
void copy_array(const Hdf5Reader& from, Hdf5Writer& to, const std::string& group, const std::string& name) {
  if (from.has(name)) to.write(group + "/" + name, from.read<T>(name));
}

// The repertoire as its artifact has it. Ids count evaluations, `batch` of them a generation.
void copy_repertoire(const std::filesystem::path& path, Hdf5Writer& to, const std::string& group) {
  const Hdf5Reader from(path);
  for (const char* name : {"id", "parent"}) copy_array<std::int64_t>(from, to, group, name);
  for (const char* name : {"solution", "measures", "objective", "uncertainty"})
    copy_array<float>(from, to, group, name);
  copy_array<std::int32_t>(from, to, group, "length");
  copy_array<std::uint8_t>(from, to, group, "image");
  for (const std::string array : {"solution", "measures"})
    write_unit_columns(to, group + "/" + array, read_unit_columns(path, array));
  write_value_meaning(to, group + "/objective", read_value_meaning(path, "objective"));
  to.attribute(group + ".layer", from.text_attribute("stage"));
  to.attribute(group + ".kind", from.text_attribute("settings.kind"));
  to.attribute(group + ".batch", from.number_attribute("settings.search.batch"));
  for (const std::string reading : {"pen", "start"})  // of what a flat digit is drawn by
    if (from.has_attribute("settings.layer." + reading))
      to.attribute(group + "." + reading, from.text_attribute("settings.layer." + reading));
}

// What the descriptor makes of the images: decoded [n x 28 x 28].
void write_decoded(const Hdf5Reader& from, Hdf5Writer& to, const std::string& group,
                   const Descriptor& descriptor, Workers& workers) {
  const auto image = from.read<std::uint8_t>("image");
  const std::size_t n = image.shape.at(0);
  Array<std::uint8_t> decoded{image.shape, std::vector<std::uint8_t>(image.values.size())};
  workers.for_ranges(n, 16, [&](std::size_t begin, std::size_t end) {
    std::vector<float> images((end - begin) * kImagePixels), again(images.size());
    for (std::size_t i = 0; i < images.size(); ++i)
      images[i] = static_cast<float>(image.values[begin * kImagePixels + i]) / 255;
    decode_images(descriptor, static_cast<Eigen::Index>(end - begin), images.data(), again.data());
    for (std::size_t i = begin; i < end; ++i)
      image_to_bytes(&again[(i - begin) * kImagePixels], &decoded.values[i * kImagePixels]);
  });
  to.write(group + "/decoded", decoded);
}

void write_verdicts(const Hdf5Reader& judged, Hdf5Writer& to, const std::string& group,
                    const std::vector<std::int64_t>& id) {
  if (judged.read<std::int64_t>(group + "/id").values != id)
    throw InputError("{}: {}: judges other digits than the repertoire holds; make it again",
                     judged.path().string(), group);
  to.write(group + "/label", judged.read<std::uint8_t>(group + "/label"));
  to.write(group + "/good", judged.read<std::uint8_t>(group + "/good"));
  to.write(group + "/confidence", judged.read<float>(group + "/confidence"));
}

// All genomes that place the pen themselves: through which elites of layer 1, one stroke after the other.
void write_ways(Hdf5Writer& to, const std::string& group, const LayerModel& model, const Elites& elites) {
  const auto n = static_cast<std::size_t>(elites.size()), strokes = static_cast<std::size_t>(model.images());
  std::vector<std::int32_t> way, points(n * strokes, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Rows genome = elites.solution.row(row).head(elites.genes(row));
    Executions executions;
    std::uint8_t possible = 0;
    model.executor()->execute(genome, nullptr, 0, 1, Seed(0), executions, &possible);
    for (std::size_t k = 0; k < executions.pen_down(0).size() && k < strokes; ++k) {
      const auto stroke = executions.stroke(0, static_cast<int>(k));
      way.insert(way.end(), stroke.begin(), stroke.end());
      points[i * strokes + k] = static_cast<std::int32_t>(stroke.size());
    }
  }
  to.write(group + "/way", way);
  to.write(group + "/points", {n, strokes}, points.data());
}

// Genomes that go on from wherever the pen is: where they stop, from random starts.
void write_executions(Hdf5Writer& to, const std::string& group, const StackOnBody& stack, int level,
                      int repeats, Seed seed) {
  const Elites& elites = stack.elites[level];
  const Executor executor = stack.stack.model(level).executor()->fresh(repeats);
  Executions executions;
  std::vector<std::uint8_t> possible(static_cast<std::size_t>(elites.size()));
  executor.execute(elites.solution, elites.length.empty() ? nullptr : elites.length.data(), 0, elites.size(),
                   seed, executions, possible.data());
  const auto n = possible.size(), r = static_cast<std::size_t>(repeats),
             stops = static_cast<std::size_t>(executions.stops());
  std::vector<std::int32_t> all(n * r * stops);
  for (std::size_t execution = 0; execution < n * r; ++execution)
    for (std::size_t k = 0; k < stops; ++k)
      all[execution * stops + k] = executions.stop(static_cast<int>(k))[execution];
  to.write(group + "/stops", {n, r, stops}, all.data());
}

void run(StageRun& stage) {
  const auto s = stage.settings_as<ExplorerSlice>();
  const Seed seed = seed_of(stage, s);
  Workers workers(stage.threads());
  const StackOnBody stack = read_stack(stage, "layer");
  const int digits = stack.level("digits");
  const std::unique_ptr<Descriptor> descriptor = load_descriptor(stage.input("descriptor"));

  Hdf5Writer file(stage.output());
  stage.write_settings(file);
  const auto digits_of = [&](const std::filesystem::path& path, const std::string& group) {
    const Hdf5Reader layer(path);
    write_decoded(layer, file, group, *descriptor, workers);
    if (stage.has_input("digits"))
      write_verdicts(Hdf5Reader(stage.input("digits")), file, group, layer.read<std::int64_t>("id").values);
  };
  for (int level = 0; level < stack.stack.size(); ++level) {
    const std::string number = fmt::format("layer{}", level + 1), group = level == digits ? "hbr" : number;
    copy_repertoire(stage.input(number), file, group);
    const LayerModel& model = stack.stack.model(level);
    if (level == digits) digits_of(stage.input(number), group);
    if (model.executor() && model.executor()->decoder().places())
      write_ways(file, group, model, stack.elites[level]);
    else if (model.executor())
      write_executions(file, group, stack, level, s.executions, seed.child(number));
  }
  if (stage.has_input("flat")) {
    copy_repertoire(stage.input("flat"), file, "flat");
    digits_of(stage.input("flat"), "flat");
  }
  file.attribute("half_side", stack.stack.points().frame().half_side);
  if (const auto* planar = dynamic_cast<const PlanarArm*>(stack.body.get()))
    file.write("links", std::vector<float>(planar->links().begin(), planar->links().end()));
  file.close();
}

}  // namespace
}  // namespace hbr::inline stages

int main(int argc, char** argv) { return hbr::stage_main(argc, argv, "What the explorer shows", hbr::run); }
