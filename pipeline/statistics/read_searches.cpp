#include <algorithm>
#include <limits>

#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/core/check.h"
#include "pipeline/core/json_text.h"
#include "pipeline/core/settings.h"
#include "pipeline/statistics/curves.h"
#include "pipeline/statistics/readers.h"
#include "pipeline/statistics/summary.h"

namespace hbr::inline statistics {
namespace {

struct Search {
  ArtifactName name;
  std::vector<ProgressRow> progress;  // ascending generations, not empty
  std::vector<std::int64_t> id;       // of the elites that it ends with: their numbers as evaluations
  double genes = 0;                   // of a genome, the longest
};

bool draws_arcs(const ArtifactName& name) { return name.head == "layer3" || name.head == "flat_arcs"; }

struct Sampled {
  double samples = 1;
};
template <class Fields>
void describe(Fields& f, Sampled& s) {
  f.number("samples", s.samples, Range{1, 1e9}, "of the stochastic descriptor");
}

// A genome that is executed from starts is so once for every sample of its stochastic descriptor, or once
// where its descriptor holds the start.
void add_executions(const Hdf5Reader& file, const std::string& prefix, double evaluations,
                    StatisticsTable& table) {
  if (!file.has_attribute("settings")) return;
  const std::string where = file.path().string() + ": settings";
  const auto settings = parse_json(file.text_attribute("settings"), where);
  if (!settings.is_object())
    throw InputError("{}: expected a table; delete the file and make it again", where);
  if (!settings.contains("layer")) return;
  const auto& layer = settings["layer"];
  if (!layer.is_object())
    throw InputError("{}: layer: expected a table; delete the file and make it again", where);
  if (!layer.contains("starts")) return;
  Sampled sampled;
  if (layer.contains("samples"))
    sampled = settings_from_json<Sampled>({{"samples", layer["samples"]}}, where + ": layer");
  table.number(prefix + ".executions", evaluations * sampled.samples);
}

Search read_search(const Artifact& artifact, StatisticsTable& table) {
  Search search{artifact.name, read_progress(artifact.path), {}, 0};
  if (search.progress.empty())
    throw InputError("{}: progress/generation is empty; expected at least one row", artifact.path.string());
  const Hdf5Reader file(artifact.path);
  const Array<float> objective = file.read<float>("objective");
  const std::vector<double> fitness(objective.values.begin(), objective.values.end());
  if (fitness.empty()) throw InputError("{}: no elites; expected at least one", artifact.path.string());

  const std::string prefix = artifact.name.prefix();
  const int replication = artifact.name.replication;
  table.add(prefix + ".size", replication, static_cast<double>(fitness.size()));
  table.add(prefix + ".best", replication, *std::ranges::max_element(fitness));
  table.add(prefix + ".mean", replication, mean(fitness));
  table.add(prefix + ".evaluations", replication, static_cast<double>(search.progress.back().evaluations));
  add_executions(file, prefix, static_cast<double>(search.progress.back().evaluations), table);
  table.number(prefix + ".generations", static_cast<double>(search.progress.back().generation));
  search.id = file.read<std::int64_t>("id").values;
  search.genes = static_cast<double>(file.read<float>("solution").shape.at(1));
  table.number(prefix + ".genes", search.genes);
  return search;
}

// The course of a search up to `generations`: the row that a search stopped there would end with.
const ProgressRow& row_at(const Search& search, std::int64_t generations) {
  const auto after = std::ranges::upper_bound(search.progress, generations, {}, &ProgressRow::generation);
  return after == search.progress.begin() ? *after : *(after - 1);
}

// A flat baseline runs longer than the layer it is compared with: compare also where both had as many
// generations, the layer's those of its longest variant.
void compare_at_equal_generations(const std::vector<const Search*>& family, StatisticsTable& table) {
  std::map<std::string, std::int64_t> longest;  // by head
  for (const Search* search : family) {
    std::int64_t& last = longest[search->name.head];
    last = std::max(last, search->progress.back().generation);
  }
  std::int64_t equal = std::numeric_limits<std::int64_t>::max();
  for (const auto& [head, last] : longest) equal = std::min(equal, last);
  for (const Search* search : family) {
    const ProgressRow& row = row_at(*search, equal);
    const std::string prefix = search->name.prefix();
    const int replication = search->name.replication;
    table.add(prefix + ".equal_size", replication, static_cast<double>(row.size));
    table.add(prefix + ".equal_best", replication, row.best);
    table.add(prefix + ".equal_mean", replication, row.mean);
    const auto covered = std::ranges::find_if(search->progress, [&](const ProgressRow& r) {
      return static_cast<double>(r.size) >= 0.9 * static_cast<double>(row.size);
    });
    table.add(prefix + ".covering_generations", replication, static_cast<double>(covered->generation));
  }
}

// Of the elites that the search held at each row of its course, the share that others have replaced by its
// end. Elites leave a repertoire by replacement alone, and ids count evaluations: those that stayed are those
// with an id from before the row.
Course replaced_later(const Search& search) {
  std::vector<std::int64_t> id = search.id;
  std::ranges::sort(id);
  Course course;
  for (const ProgressRow& row : search.progress) {
    const std::int64_t stayed = std::ranges::lower_bound(id, row.evaluations) - id.begin();
    if (stayed > row.size)
      throw InputError("{}/{:02}: {} elites are from before generation {}, when it held {}; make it again",
                       search.name.prefix(), search.name.replication, stayed, row.generation, row.size);
    course.emplace_back(static_cast<double>(row.generation),
                        row.size > 0 ? 1 - static_cast<double>(stayed) / static_cast<double>(row.size) : 0);
  }
  return course;
}

// How much is still replaced in the second half of a search, and what it brings.
void add_second_half(const Search& search, StatisticsTable& table) {
  const ProgressRow& half = row_at(search, search.progress.back().generation / 2);
  const std::string prefix = search.name.prefix();
  const auto at = static_cast<double>(half.generation);
  const Course course = replaced_later(search);
  const auto replaced = std::ranges::find(course, at, &Course::value_type::first);
  table.add(prefix + ".replaced", search.name.replication, replaced->second);
  table.add(prefix + ".late_gain", search.name.replication, search.progress.back().mean - half.mean);
}

void add_curves(const std::vector<const Search*>& replications, StatisticsTable& table) {
  std::vector<Course> size, best, mean, replaced;
  for (const Search* search : replications) {
    Course s, b, m;
    for (const ProgressRow& row : search->progress) {
      const auto at = static_cast<double>(row.generation);
      s.emplace_back(at, static_cast<double>(row.size));
      b.emplace_back(at, row.best);
      m.emplace_back(at, row.mean);
    }
    size.push_back(s), best.push_back(b), mean.push_back(m);
    if (draws_arcs(search->name)) replaced.push_back(replaced_later(*search));
  }
  const std::string prefix = replications.front()->name.prefix();
  add_curve(table, prefix, "generation", "size", size);
  add_curve(table, prefix, "generation", "best", best);
  add_curve(table, prefix, "generation", "mean", mean);
  if (!replaced.empty()) add_curve(table, prefix, "generation", "replaced", replaced);
}

// The paper gives one size for all its variants of layer 2.
void add_pooled_size(StatisticsTable& table, const std::vector<Search>& searches) {
  std::vector<double> sizes;
  for (const Search& search : searches)
    if (search.name.head == "layer2") sizes.push_back(static_cast<double>(search.progress.back().size));
  if (!sizes.empty()) table.number("pooled.layer2_size", summarise(sizes, "pooled.layer2_size").median);
}

// What the hierarchy searches, beside a flat genome: points, lines and arcs by controller B (paper,
// section 5.4).
void add_hierarchy_genes(StatisticsTable& table, const std::vector<Search>& searches) {
  double sum = 0;
  for (const auto& name : {std::pair{"layer1", ""}, std::pair{"layer2", "n10"}, std::pair{"layer3", "b"}}) {
    const auto found = std::ranges::find_if(searches, [&](const Search& s) {
      return s.name.head == name.first && s.name.variant == name.second;
    });
    if (found == searches.end()) return;
    sum += found->genes;
  }
  table.number("genes.hierarchy", sum);
}

}  // namespace

void read_searches(const ArtifactsByHead& artifacts, StatisticsTable& table) {
  std::vector<Search> searches;
  for (const auto& [head, list] : artifacts)
    if (is_search(head))
      for (const Artifact& artifact : list) searches.push_back(read_search(artifact, table));

  std::map<std::string, std::vector<const Search*>> by_prefix;
  for (const Search& search : searches) by_prefix[search.name.prefix()].push_back(&search);
  for (const auto& [prefix, replications] : by_prefix) add_curves(replications, table);
  for (const Search& search : searches)
    if (draws_arcs(search.name)) add_second_half(search, table);

  for (const auto& [layer, flat] : {std::pair{"layer3", "flat_arcs"}, std::pair{"layer4", "flat_digits"}}) {
    std::vector<const Search*> family;
    for (const Search& search : searches)
      if (search.name.head == layer || search.name.head == flat) family.push_back(&search);
    compare_at_equal_generations(family, table);
  }
  add_pooled_size(table, searches);
  add_hierarchy_genes(table, searches);
}

}  // namespace hbr::inline statistics
