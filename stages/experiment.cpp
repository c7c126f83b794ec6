#include "stages/experiment.h"

#include <algorithm>
#include <cstdlib>
#include <set>

#include "models/simbody/find_mesh.h"
#include "pipeline/artifact/profile.h"
#include "pipeline/artifact/variations.h"
#include "pipeline/core/check.h"
#include "stages/profile.h"

namespace hbr {
namespace {

using nlohmann::json;

std::string numbered(const std::string& stage, int replication) {
  return fmt::format("{}/{:02}.h5", stage, replication);
}

// The four files of a dataset, gzipped where they are not there plain.
std::vector<std::string> idx_files(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  for (const char* name : {"train-images-idx3-ubyte", "train-labels-idx1-ubyte", "t10k-images-idx3-ubyte",
                           "t10k-labels-idx1-ubyte"}) {
    const std::filesystem::path plain = folder / name, gzipped = plain.string() + ".gz";
    files.push_back(!exists(plain) && exists(gzipped) ? gzipped : plain);
  }
  return files;
}

void check_name(const std::string& where, const std::string& table, const std::string& name) {
  const auto fits = [](char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; };
  if (name.empty() || !std::all_of(name.begin(), name.end(), fits))
    throw InputError("{}: {}: name '{}': expected letters, digits and _", where, table, name);
}

const std::string kStatistics = "statistics.json", kNaoMeshes = "nao_meshes";

// What the pictures of a robot read beside artifacts: the URDF and the meshes that it names. Of a URDF that
// can't be read only itself: the stages that need it say why, and the rest of the experiment goes on.
std::vector<std::string> looks_of(const RobotSettings& robot) {
  std::vector<std::string> sources{robot.urdf};
  if (robot.meshes == kNaoMeshes) return sources;
  try {
    for (const std::filesystem::path& mesh : mesh_files(load_urdf(robot.urdf), robot.meshes))
      sources.push_back(mesh.string());
  } catch (const InputError&) {
  }
  return sources;
}

// Cuts the profile: every function adds the runs of one stage, told no more than they depend on.
class Experiment {
 public:
  // `where` leads the errors.
  Experiment(Profile profile, std::string where) : p_(std::move(profile)), where_(std::move(where)) {
    check();
  }

  // From the data to the statistics.
  Graph graph() {
    data();
    for (int r = 0; r < p_.replications.lines; ++r) {
      points(r);
      lines(r);
      arcs(r);
      experiments(r);
    }
    searches();
    for (int r = 0; r < p_.replications.digits; ++r) digits(r);
    for (const RobotSettings& robot : p_.robots) {
      transfer(robot);
      tuning(robot.name, {robot});
    }
    if (!p_.robots.empty()) tuning("arm", {});
    statistics();
    return std::move(graph_);
  }

 private:
  [[noreturn]] void fail(const std::string& what) const { throw InputError("{}: {}", where_, what); }

  template <class Variants>
  void check_names(const std::string& table, const Variants& variants) const {
    std::set<std::string> seen;
    for (const auto& v : variants) {
      check_name(where_, table, v.name);
      if (!seen.insert(v.name).second) fail(fmt::format("{}: name '{}' stands twice", table, v.name));
    }
  }

  template <class Variant>
  const Variant& named(const std::vector<Variant>& variants, const std::string& name, const char* key,
                       const char* table) const {
    std::vector<std::string> names;
    for (const Variant& v : variants) {
      if (v.name == name) return v;
      names.push_back(v.name);
    }
    fail(fmt::format("{} = '{}': expected the name of one of {} ({})", key, name, table,
                     fmt::join(names, ", ")));
  }

  void check() const {
    check_names("layer2.variants", p_.layer2.variants);
    check_names("layer3.variants", p_.layer3.variants);
    check_names("robots", p_.robots);
    if (std::ranges::find(p_.robots, "arm", &RobotSettings::name) != p_.robots.end())
      fail("robots: name 'arm' is the planar arm's; expected another");
    check_names("searches.variants", p_.searches.variants);
    named(p_.layer2.variants, p_.layer3.lines, "layer3.lines", "layer2.variants");
    named(p_.layer3.variants, p_.layer4.arcs, "layer4.arcs", "layer3.variants");
    named(p_.layer3.variants, p_.experiments.substitution_variant, "experiments.substitution_variant",
          "layer3.variants");
    if (p_.replications.digits > p_.replications.lines)
      fail(
          fmt::format("replications.digits = {}: expected at most replications.lines ({}), whose layers the "
                      "digits are built on",
                      p_.replications.digits, p_.replications.lines));
    if (p_.descriptor.kind == "onnx" && p_.descriptor.file.empty())
      fail("descriptor: kind = 'onnx' with file = ''; expected the path of an ONNX network");
    if (p_.layer4.pencil.thinnest_px > p_.layer4.pencil.thickest_px)
      fail(fmt::format("layer4.pencil: thinnest_px = {} exceeds thickest_px = {}",
                       p_.layer4.pencil.thinnest_px, p_.layer4.pencil.thickest_px));
  }

  // --- slices

  // The shared part of the search, the archive of a layer, the generations of a variant.
  json search(const SearchTable& archive, const SearchTable& generations) const {
    SearchTable t = p_.search;
    t.spacing = archive.spacing;
    t.epsilon = archive.epsilon;
    t.generations = generations.generations;
    return settings_to_json(t);
  }
  json run(int replication) const { return {{"seed", p_.seed}, {"replication", replication}}; }
  json arm(int replication) const {
    json s = run(replication);
    s["arm"] = settings_to_json(p_.arm);
    s["half_side"] = p_.half_side;
    return s;
  }
  json lines_slice(int replication) const {
    json s = arm(replication);
    s["longest_line"] = p_.longest_line;
    s["line_range"] = p_.line_range;
    return s;
  }
  json arcs_slice(int replication) const {
    return with(lines_slice(replication), {{"reading", settings_to_json(p_.layer3.reading)}});
  }
  static json with(json settings, const json& more) {
    settings.update(more);
    return settings;
  }

  using Inputs = std::vector<std::pair<std::string, std::string>>;
  void add(const std::string& program, const std::string& stage, int replication, json settings,
           Inputs inputs, std::vector<std::string> sources = {}) {
    const std::string output = replication < 0 ? stage + ".h5" : numbered(stage, replication);
    graph_.push_back(
        {program, stage, replication, output, std::move(settings), std::move(inputs), std::move(sources)});
  }

  // --- stages

  void data() {
    if (p_.replications.digits == 0) return;
    DatasetSettings dataset = p_.dataset;
    if (const char* folder = std::getenv("MNIST_DIR"); folder && *folder && dataset.name == "mnist")
      dataset.folder = folder;
    add("dataset", "dataset", -1, settings_to_json(dataset), {}, idx_files(dataset.folder));
    add("judge", "judge", -1,
        {{"seed", p_.seed},
         {"judge", settings_to_json(p_.judge)},
         {"random_strokes", settings_to_json(p_.random_strokes)}},
        {{"dataset", "dataset.h5"}});
    if (own_networks()) return;
    DescriptorSlice slice{p_.descriptor, p_.autoencoder.latent_size};
    std::vector<std::string> sources;
    if (slice.kind == "onnx") sources.push_back(slice.file);
    add("descriptor", "descriptor", -1, settings_to_json(slice), {{"dataset", "dataset.h5"}}, sources);
  }

  // Each replication trains its own autoencoder; other descriptors are the same for all.
  bool own_networks() const { return p_.descriptor.kind == "autoencoder"; }

  void points(int r) {
    const json s = with(arm(r), {{"search", search(p_.layer1, p_.layer1)}});
    add("layer1", "layer1", r, with(s, {{"cost", "joint_variance"}}), {});
    add("layer1", "layer1_substitute", r, with(s, {{"cost", "few_joints"}}), {});
  }

  // Layer 1 by searches made of other parts, and what they come to on one grid.
  void searches() {
    Inputs inputs;
    for (const SearchVariant& v : p_.searches.variants)
      for (int r = 0; r < p_.searches.replications; ++r) {
        const json parts{{"container", v.search.container}, {"selector", v.search.selector}};
        const std::string stage = "layer1_search_" + v.name;
        add("layer1", stage, r,
            with(arm(r), {{"cost", "joint_variance"},
                          {"search", with(search(p_.layer1, p_.searches.search), parts)}}),
            {});
        inputs.emplace_back(fmt::format("{}/{:02}", v.name, r), numbered(stage, r));
      }
    if (inputs.empty()) return;
    // Values in [-a, a] have a variance of at most a^2.
    const double worst_fitness = -p_.arm.joint_limit * p_.arm.joint_limit;
    add("searches", "searches", -1,
        {{"passive_cells", p_.searches.passive_cells}, {"worst_fitness", worst_fitness}}, inputs);
  }

  void lines(int r) {
    const Inputs inputs{{"layer1", numbered("layer1", r)}};
    const auto slice = [&](int samples, const SearchTable& generations) {
      return with(lines_slice(r), {{"samples", samples}, {"search", search(p_.layer2.archive, generations)}});
    };
    for (const LineVariant& v : p_.layer2.variants)
      add("layer2", "layer2_" + v.name, r, slice(v.samples, v.search), inputs);
    add("reference4d", "reference4d", r, slice(1, p_.reference4d), inputs);
  }

  void arcs(int r) {
    for (const ArcVariant& v : p_.layer3.variants)
      add("layer3", "layer3_" + v.name, r,
          with(arcs_slice(r), {{"controller", v.controller},
                               {"samples", v.samples},
                               {"search", search(p_.layer3.archive, v.search)}}),
          {{"layer1", numbered("layer1", r)}, {"layer2", numbered("layer2_" + p_.layer3.lines, r)}});
    add("flat_arcs", "flat_arcs", r,
        with(arcs_slice(r),
             {{"start", p_.flat_arcs.start}, {"search", search(p_.layer3.archive, p_.flat_arcs)}}),
        {});
  }

  void experiments(int r) {
    Inputs contenders{{"layer1", numbered("layer1", r)}, {"reference4d", numbered("reference4d", r)}};
    for (const LineVariant& v : p_.layer2.variants)
      contenders.emplace_back(v.name, numbered("layer2_" + v.name, r));
    add("accuracy", "accuracy", r, with(lines_slice(r), {{"requests", p_.experiments.accuracy_requests}}),
        contenders);

    const std::pair<std::string, std::string> below{"layer2", numbered("layer2_" + p_.layer3.lines, r)};
    Inputs layers{{"layer1", numbered("layer1", r)}, below};
    json variants = json::array();
    for (const ArcVariant& v : p_.layer3.variants) {
      layers.emplace_back("layer3_" + v.name, numbered("layer3_" + v.name, r));
      variants.push_back(settings_to_json<ArcVariantTable>(v));
    }
    add("arc_quality", "arc_quality", r,
        with(arcs_slice(r), {{"fresh_starts", p_.experiments.fresh_starts}, {"variants", variants}}), layers);

    const ArcVariant& v = named(p_.layer3.variants, p_.experiments.substitution_variant, "", "");
    add("substitution", "substitution", r,
        with(arcs_slice(r), {{"variant", settings_to_json<ArcVariantTable>(v)}}),
        {{"original", numbered("layer1", r)},
         {"substitute", numbered("layer1_substitute", r)},
         below,
         {"layer3", numbered("layer3_" + v.name, r)}});
  }

  // What it takes to draw a digit's genome.
  json digits_slice(int r) const {
    return with(lines_slice(r), {{"controller", named(p_.layer3.variants, p_.layer4.arcs, "", "").controller},
                                 {"line_spacing", p_.layer4.line_spacing},
                                 {"out_of_range", p_.layer4.out_of_range},
                                 {"pencil", settings_to_json(p_.layer4.pencil)}});
  }
  Inputs hierarchy(int r) const {
    return {{"layer1", numbered("layer1", r)},
            {"layer2", numbered("layer2_" + p_.layer3.lines, r)},
            {"layer3", numbered("layer3_" + p_.layer4.arcs, r)}};
  }

  void digits(int r) {
    std::pair<std::string, std::string> descriptor{"descriptor", "descriptor.h5"};
    if (own_networks()) {
      descriptor.second = numbered("autoencoder", r);
      add("autoencoder", "autoencoder", r, with(run(r), settings_to_json(p_.autoencoder)),
          {{"dataset", "dataset.h5"}});
      graph_.push_back({"onnx",
                        "onnx",
                        r,
                        fmt::format("onnx/{:02}", r),
                        json::object(),
                        {{"autoencoder", descriptor.second}},
                        {}});
    }
    Inputs below = hierarchy(r);
    below.push_back(descriptor);
    add("layer4", "layer4", r,
        with(digits_slice(r), {{"length_rate", p_.layer4.length_rate},
                               {"search", search(p_.layer4.search, p_.layer4.search)}}),
        below);
    add("flat_digits", "flat_digits", r,
        with(arm(r), {{"pen", p_.flat_digits.pen},
                      {"start", p_.flat_digits.start},
                      {"pencil", settings_to_json(p_.layer4.pencil)},
                      {"length_rate", p_.layer4.length_rate},
                      {"search", search(p_.layer4.search, p_.flat_digits)}}),
        {descriptor});
    add("digits", "digits", r, json::object(),
        {{"dataset", "dataset.h5"},
         {"judge", "judge.h5"},
         {"hbr", numbered("layer4", r)},
         {"flat", numbered("flat_digits", r)}});
    Inputs drawn = hierarchy(r);
    drawn.insert(drawn.end(), {{"layer4", numbered("layer4", r)}, {"digits", numbered("digits", r)}});
    add("strokes", "strokes", r, digits_slice(r), drawn);
  }

  void transfer(const RobotSettings& robot) {
    if (p_.replications.digits == 0) return;
    const json body = settings_to_json(robot);
    const std::string plane = robot.name + "_plane";
    add("robot_plane", plane, -1,
        {{"seed", p_.seed},
         {"half_side", p_.half_side},
         {"robot", body},
         {"search", settings_to_json(p_.robot_plane)}},
        {{"layer1", numbered("layer1", 0)}}, {robot.urdf});
    for (int r = 0; r < p_.replications.digits; ++r) {
      add("robot_layer1", robot.name + "_layer1", r,
          with(run(r), {{"half_side", p_.half_side},
                        {"cost", "joint_variance"},
                        {"robot", body},
                        {"search", search(p_.robot_layer1, p_.robot_layer1)}}),
          {{"plane", plane + ".h5"}}, {robot.urdf});
      add("robot_polish", robot.name + "_polish", r,
          with(run(r), {{"half_side", p_.half_side}, {"spacing", p_.robot_layer1.spacing}, {"robot", body}}),
          {{"plane", plane + ".h5"},
           {"robot_layer1", numbered(robot.name + "_layer1", r)},
           {"layer1", numbered("layer1", r)}},
          {robot.urdf});
      Inputs inputs = hierarchy(r);
      inputs.insert(inputs.end(), {{"plane", plane + ".h5"},
                                   {"robot_layer1", numbered(robot.name + "_polish", r)},
                                   {"layer4", numbered("layer4", r)},
                                   {"digits", numbered("digits", r)}});
      add("robot_transfer", robot.name + "_transfer", r,
          with(digits_slice(r), {{"reading", settings_to_json(p_.layer3.reading)},
                                 {"transfer", settings_to_json(p_.transfer)},
                                 {"robot", body}}),
          inputs, {robot.urdf});
      inputs.pop_back();  // the judge's verdicts
      add("robot_dynamics", robot.name + "_dynamics", r,
          with(digits_slice(r), {{"dynamics", settings_to_json(p_.dynamics)}, {"robot", body}}), inputs,
          {robot.urdf});
    }

    Inputs inputs{{"plane", plane + ".h5"}, {"strokes", numbered(robot.name + "_transfer", 0)}};
    if (robot.meshes == kNaoMeshes) {  // made, not found
      if (std::ranges::find(graph_, kNaoMeshes, &Node::stage) == graph_.end())
        graph_.push_back({kNaoMeshes, kNaoMeshes, -1, kNaoMeshes, json::object(), {}, {}});
      inputs.emplace_back("meshes", kNaoMeshes);
    }
    graph_.push_back({"robot_picture",
                      robot.name + "_picture",
                      -1,
                      robot.name + "_picture",
                      {{"half_side", p_.half_side}, {"height", p_.robot_picture.height}, {"robot", body}},
                      inputs,
                      looks_of(robot)});
  }

  // The arm's layers evolve on over a robot; over none, over the arm itself, which is the control.
  void tuning(const std::string& name, const std::vector<RobotSettings>& robot) {
    json body = json::array();
    std::vector<std::string> urdf;
    for (RobotSettings each : robot) body.push_back(settings_to_json(each)), urdf.push_back(each.urdf);
    for (int r = 0; r < p_.replications.digits; ++r) {
      const auto stage = [&](const std::string& layer) { return name + "_tuned_" + layer; };
      Inputs points{{"points", numbered(robot.empty() ? "layer1" : name + "_polish", r)}};
      if (!robot.empty()) points.emplace_back("plane", name + "_plane.h5");
      const Inputs arm = hierarchy(r);
      const std::string layer2 = arm[1].second, layer3 = arm[2].second, layer4 = numbered("layer4", r);
      const std::pair<std::string, std::string> tuned_lines{"lines", numbered(stage("lines"), r)},
          tuned_arcs{"arcs", numbered(stage("arcs"), r)},
          descriptor{"descriptor", own_networks() ? numbered("autoencoder", r) : "descriptor.h5"};
      const auto evolve_on = [&](const char* program, const std::string& layer, const json& slice,
                                 const SearchTable& archive, const SearchTable& before, std::int64_t more,
                                 const Inputs& others) {
        SearchTable longer = before;
        longer.generations += more;
        Inputs inputs = points;
        inputs.insert(inputs.end(), others.begin(), others.end());
        add(program, stage(layer), r,
            with(slice, {{"search", search(archive, longer)}, {"robot", body}, {"more", more}}), inputs,
            urdf);
      };

      const LineVariant& line = named(p_.layer2.variants, p_.layer3.lines, "", "");
      evolve_on("tuned_lines", "lines", with(lines_slice(r), {{"samples", line.samples}}), p_.layer2.archive,
                line.search, p_.tuning.line_generations, {{"layer2", layer2}});
      const ArcVariant& arc = named(p_.layer3.variants, p_.layer4.arcs, "", "");
      evolve_on("tuned_arcs", "arcs",
                with(arcs_slice(r), {{"controller", arc.controller}, {"samples", arc.samples}}),
                p_.layer3.archive, arc.search, p_.tuning.arc_generations, {tuned_lines, {"layer3", layer3}});
      const json digit = with(digits_slice(r), {{"length_rate", p_.layer4.length_rate}});
      const SearchTable& layer = p_.layer4.search;
      evolve_on("tuned_digits", "top", digit, layer, layer, p_.tuning.digit_generations,
                {{"lines", layer2}, {"arcs", layer3}, {"layer4", layer4}, descriptor});
      evolve_on("tuned_digits", "all", digit, layer, layer, p_.tuning.digit_generations,
                {tuned_lines, tuned_arcs, {"layer4", layer4}, descriptor});

      Inputs drawn = points;
      drawn.insert(drawn.end(), arm.begin(), arm.end());
      drawn.insert(drawn.end(), {{"layer4", layer4},
                                 tuned_lines,
                                 tuned_arcs,
                                 {"top", numbered(stage("top"), r)},
                                 {"all", numbered(stage("all"), r)},
                                 descriptor,
                                 {"dataset", "dataset.h5"},
                                 {"judge", "judge.h5"}});
      add("robot_tuned", name + "_tuned", r,
          with(digits_slice(r), {{"reading", settings_to_json(p_.layer3.reading)},
                                 {"transfer", settings_to_json(p_.transfer)},
                                 {"line_places", p_.layer2.archive.spacing},
                                 {"arc_places", p_.layer3.archive.spacing},
                                 {"robot", body}}),
          drawn, urdf);
    }
  }

  // Everything before, by its own name.
  void statistics() {
    Inputs measured;
    json generations = json::object();
    for (const Node& node : graph_) {
      if (node.output.ends_with(".h5")) measured.emplace_back(node.output, node.output);
      if (node.settings.contains("search")) generations[node.stage] = node.settings["search"]["generations"];
    }
    const json settings{{"profile", p_.name},
                        {"replications", settings_to_json(p_.replications)},
                        {"generations", generations}};
    graph_.push_back({"statistics", "statistics", -1, kStatistics, settings, measured, {}});
  }

  Profile p_;
  std::string where_;
  Graph graph_;
};

// The profile with a variation's changes, read as strictly as the profile itself.
Profile varied(const SettingsSource& source, std::size_t index, const ProfileVariation& variation) {
  const SettingsSource changes = part_of(source, fmt::format("/variations/{}/set", index));
  for (const char* key : {"name", "variations"})
    if (changes.values.contains(key)) {
      const SettingsSource::Position at = changes.keys.at(std::string("/") + key);
      throw InputError("{}:{}:{}: variation '{}' can't change '{}'; expected a key that a stage depends on",
                       at.file, at.line, at.column, variation.name, key);
    }
  auto profile = settings_from_source<Profile>(laid_over(source, changes));
  profile.name += "/" + variation.name;
  profile.variations.clear();
  return profile;
}

// A variation's name is a make goal and a folder beside those of the stages.
void check_variations(const std::string& file, const Profile& profile, const Graph& graph) {
  std::set<std::string> taken{"all", "page", "report"};
  for (const Node& node : graph) taken.insert({node.stage, node.stage.substr(0, node.stage.find('_'))});
  for (const ProfileVariation& v : profile.variations) {
    check_name(file, "variations", v.name);
    if (!taken.insert(v.name).second)
      throw InputError("{}: variations: name '{}' stands twice, or is a stage's", file, v.name);
    if (v.changes.empty())
      throw InputError("{}: variation '{}' has no `changes`; expected a sentence for the report", file,
                       v.name);
  }
}

// The page: everything of the experiment by its own name, and the statistics of every variation.
Node report_of(const Profile& profile, const Graph& graph) {
  const std::string claims = "reports/claims.toml", readings = "reports/readings.toml",
                    speed = "reports/reference/bench.json";
  json settings = {
      {"claims", claims}, {"readings", readings}, {"speed", speed}, {"variations", json::array()}};
  for (const ProfileVariation& v : profile.variations)
    settings["variations"].push_back({{"name", v.name}, {"changes", v.changes}});
  std::vector<std::pair<std::string, std::string>> inputs;
  for (const Node& node : graph)
    if (node.variation.empty() || node.stage == "statistics") inputs.emplace_back(node.output, node.output);
  return {"report", "report", -1, "page", settings, inputs, {claims, readings, speed}};
}

}  // namespace

Graph experiment_graph(const std::filesystem::path& file) {
  const SettingsSource source = read_inheriting(file);
  const auto profile = settings_from_source<Profile>(source);
  Graph graph = Experiment(profile, file.string()).graph();
  check_variations(file.string(), profile, graph);
  for (std::size_t i = 0; i < profile.variations.size(); ++i) {
    const ProfileVariation& v = profile.variations[i];
    const std::string where = fmt::format("{}: variation '{}'", file.string(), v.name);
    const std::size_t before = graph.size();
    add_variation(graph, v.name, Experiment(varied(source, i, v), where).graph());
    if (graph.size() - before < 2)  // the statistics are always its own
      throw InputError("{} changes nothing that this profile runs; expected keys that a stage depends on",
                       where);
  }
  graph.push_back(report_of(profile, graph));
  return graph;
}

}  // namespace hbr
