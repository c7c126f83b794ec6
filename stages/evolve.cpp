#include "stages/evolve.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <numeric>

#include "pipeline/artifact/temporary.h"
#include "pipeline/core/parallel.h"
#include "pipeline/qd/cvt_archive.h"
#include "pipeline/qd/distance_archive.h"
#include "pipeline/qd/grid_archive.h"
#include "pipeline/qd/score_selectors.h"
#include "pipeline/qd/search.h"

namespace hbr {
namespace {

constexpr std::chrono::seconds kCheckpointEvery{20};

// `centroids`: of the cvt container.
std::unique_ptr<Repertoire> make_repertoire(const SearchTable& t, int genes, int size, DescriptorRange range,
                                            const Rows& centroids) {
  if (t.container == "grid")
    return std::make_unique<GridArchive>(genes, GridCells{size, t.grid_cells, range.low, range.high});
  if (t.container == "cvt") return make_cvt_archive(genes, centroids, range.low, range.high);
  return make_distance_archive(
      genes, size,
      {static_cast<float>(t.spacing), static_cast<float>(t.epsilon), t.neighbours, range.low, range.high,
       t.container == "local_competition" ? Contest::kFitness : Contest::kDominance});
}

std::unique_ptr<Selector> make_selector(const SearchTable& t, int size, DescriptorRange range) {
  const auto scores = [&] { return make_local_scores(size, t.neighbours, range.low, range.high); };
  if (t.selector == "uniform") return std::make_unique<UniformSelector>();
  if (t.selector == "fitness") return std::make_unique<FitnessSelector>();
  if (t.selector == "novelty") return std::make_unique<NoveltySelector>(scores());
  if (t.selector == "nslc") return std::make_unique<NslcSelector>(scores());
  return std::make_unique<CuriositySelector>();
}

// Elites in id order, and the order of their slots beside them.
void write_checkpoint(const std::filesystem::path& path, const SearchState& state) {
  std::vector<std::int32_t> order(state.elites.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](auto a, auto b) { return state.elites.id[a] < state.elites.id[b]; });
  const std::filesystem::path unfinished = temporary_beside(path);
  Hdf5Writer file(unfinished);
  write_elites(file, in_order(state.elites, order), state.progress);
  file.write("slot", order);
  file.write("selector", state.selector);
  file.write("generation", std::vector<std::int64_t>{state.generation});
  file.close();
  std::filesystem::rename(unfinished, path);
}

SearchState read_checkpoint(const std::filesystem::path& path) {
  const Hdf5Reader file(path);
  const std::vector<std::int32_t> slot = file.read<std::int32_t>("slot").values;
  std::vector<std::int32_t> order(slot.size());
  for (std::size_t i = 0; i < slot.size(); ++i) order.at(slot[i]) = static_cast<std::int32_t>(i);
  return {file.read<std::int64_t>("generation").values.at(0), in_order(read_elites(path), order),
          file.read<std::int64_t>("selector").values, read_progress(path)};
}

}  // namespace

void evolve(StageRun& stage, const SearchTable& table, const Variation& variation, const Evaluator& evaluator,
            Seed seed, DescriptorRange range, const std::function<void(Hdf5Writer&, const Elites&)>& more) {
  const int size = evaluator.descriptor_size();
  Rows centroids;
  if (table.container == "cvt")
    centroids = cvt_centroids(table.cvt_cells, size, range.low, range.high, seed.child("centroids"));
  const auto repertoire = make_repertoire(table, variation.genes(), size, range, centroids);
  const auto selector = make_selector(table, size, range);
  Search search(*repertoire, *selector, variation, evaluator,
                {table.generations, table.batch, table.record_every,
                 table.curiosity_credit == "published" ? Credit::kPublished : Credit::kParent},
                seed);
  if (std::filesystem::exists(stage.checkpoint())) search.resume(read_checkpoint(stage.checkpoint()));

  Workers workers(stage.threads());
  auto saved = std::chrono::steady_clock::now();
  while (!search.done()) {
    search.step(workers);
    stage.progress(search.generation(), table.generations, "generations");
    if (const auto now = std::chrono::steady_clock::now(); now - saved > kCheckpointEvery) {
      write_checkpoint(stage.checkpoint(), search.state());
      saved = now;
    }
  }
  if (repertoire->size() == 0)
    throw InputError("{}: no solution had a behaviour in {} evaluations; nothing to store", stage.name(),
                     table.generations * table.batch);

  Elites elites = repertoire->store().in_id_order();
  if (!evaluator.stochastic()) elites.uncertainty.resize(0);
  if (variation.fixed_length()) elites.length.clear();
  Hdf5Writer file(stage.output());
  write_elites(file, elites, search.progress());
  if (centroids.size() > 0)
    file.write("centroids",
               {static_cast<std::size_t>(centroids.rows()), static_cast<std::size_t>(centroids.cols())},
               centroids.data());
  stage.write_settings(file);
  if (more) more(file, elites);
  file.close();
}

PolynomialMutation fixed_length(int genes, const SearchTable& table) {
  return {genes, static_cast<float>(table.mutation_eta), static_cast<float>(table.mutation_rate)};
}

PlanarArm make_arm(const ArmTable& table) { return {table.links, table.joint_limit}; }

Frame make_frame(const LinesSlice& slice) {
  return {slice.half_side, slice.longest_line,
          slice.line_range == "square" ? LineRange::kSquare : LineRange::kDisc};
}

ArcReading make_reading(const ArcReadingTable& table) { return arc_reading(table.centre, table.joint_term); }

Pencil make_pencil(const PencilTable& table) {
  return {framing_named(table.framing), table.thinnest_px, table.thickest_px};
}

PointLayer read_points(const StageRun& stage, const std::string& name, const Robot& robot,
                       const Frame& frame) {
  return {read_elites(stage.input(name)), robot, frame};
}

LineLayer read_lines(const StageRun& stage, const std::string& name, const Frame& frame) {
  return {read_elites(stage.input(name)), frame};
}

ArcLayer read_arcs(const StageRun& stage, const std::string& name, const Frame& frame,
                   const std::string& controller) {
  return {read_elites(stage.input(name)), frame, arc_controller(controller)};
}

}  // namespace hbr
