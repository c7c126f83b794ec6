// A profile on its way to a graph of stages: what the parts of the plan share.
#pragma once

#include "pipeline/artifact/graph.h"
#include "stages/plan/layer_rows.h"
#include "stages/plan/profile.h"

namespace hbr::inline stages {

using Inputs = std::vector<std::pair<std::string, std::string>>;

inline std::string numbered(const std::string& stage, int replication) {
  return fmt::format("{}/{:02}.h5", stage, replication);
}

class Plan {
 public:
  // `where` leads the errors about what names and numbers mean together.
  Plan(const SettingsSource& source, std::string where);

  const Profile& profile() const { return profile_; }
  const std::vector<LayerRow>& rows() const { return rows_; }
  [[noreturn]] void fail(const std::string& what) const { throw InputError("{}: {}", where_, what); }

  // The layer that a study names by `key`; throws InputError where it is not there or not of the kind.
  const LayerRow& layer(const std::string& name, const char* key, const char* kind = nullptr) const;
  // The layer and those that it is built on, the lowest first; none for "".
  std::vector<const LayerRow*> stack(const std::string& name) const;
  // Whether a layer, or one that it is built on, asks for a learned descriptor, and how often it is evolved.
  bool learned(const LayerRow& row) const;
  int replications(const LayerRow& row) const;
  // Whether each replication trains its own autoencoder; other descriptors are the same for all.
  bool own_networks() const { return profile_.descriptor.kind == "autoencoder"; }
  std::pair<std::string, std::string> descriptor(int replication) const;

  // Inputs NAME1, NAME2, ...: the artifacts of a stack.
  Inputs inputs(const std::string& name, const std::vector<const LayerRow*>& stack, int replication) const;
  // What every replicated stage is told.
  nlohmann::json run(int replication) const {
    return {{"seed", profile_.seed}, {"replication", replication}};
  }
  nlohmann::json arm() const { return {{"arm", settings_to_json(profile_.arm)}}; }
  // A run of the stage `layer`: a row by this name over these inputs. `more`: of its generations those that
  // it does, by the elites of the input `elites`; 0: all.
  void add_layer(const std::string& name, const LayerRow& row, int replication, const nlohmann::json& body,
                 Inputs below, std::vector<std::string> sources = {}, std::int64_t more = 0);

  // What is read of the numbers of a stack, whose inputs are called layer1, layer2, ...
  void add_numbers(const std::string& name, Inputs stack, int replication,
                   std::vector<std::string> sources = {});

  void add(const std::string& program, const std::string& stage, int replication, nlohmann::json settings,
           Inputs inputs, std::vector<std::string> sources = {});
  void add(Node node) { graph_.push_back(std::move(node)); }
  Graph& graph() { return graph_; }

 private:
  void check() const;

  Profile profile_;
  std::vector<LayerRow> rows_;
  std::string where_;
  Graph graph_;
};

nlohmann::json with(nlohmann::json settings, const nlohmann::json& more);
// Throws InputError where it is not made of letters, digits and _.
void check_name(const std::string& where, const std::string& table, const std::string& name);

// Each adds its stages.
void plan_learned(Plan& plan);
void plan_layers(Plan& plan);
void plan_studies(Plan& plan);
void plan_robots(Plan& plan);
// Everything before, by its own name.
void plan_statistics(Plan& plan);
// What the report lets its readers explore.
void plan_explorer(Plan& plan);
// The arm and the robots in three dimensions.
void plan_shown_robots(Plan& plan);

}  // namespace hbr::inline stages
